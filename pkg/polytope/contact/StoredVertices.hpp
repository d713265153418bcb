// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/FlatArchive.hpp"

#include <src/surface/KeptVertices.hpp>

#include <boost/container/small_vector.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace yade {

/// A contact's polytope::KeptVertices as far as they are used, the planes in a byte each where they fit, as those of bodies with up to 127
/// planes do. Those of most contacts are within the geometry itself: the next pair's come into the cache with it (Prefetch.hpp).
class StoredVertices {
public:
	/// Needs new memory only where there are more vertices than ever before.
	void set(const polytope::KeptVertices& kept)
	{
		if (kept.vertices == 0) {
			codes_.clear();
			return;
		}
		const std::size_t planes = kept.planes, vertices = kept.vertices;
		const auto        begin = kept.plane.begin(), end = begin + planes;
		const bool        wide = std::any_of(
                        begin, end, [](int name) { return name >= noPressure && name != polytope::KeptVertices::noPressure; });
		codes_.resize(header + planes * (wide ? 2 : 1) + vertices * bytesOfVertex, boost::container::default_init);
		codes_[0] = kept.planes;
		codes_[1] = kept.vertices;
		codes_[2] = Byte(2 * kept.shared + kept.exchanged);
		codes_[3] = wide;
		Byte* to  = codes_.data() + header;
		for (auto name = begin; name != end; ++name) {
			*to++ = Byte(!wide && *name == polytope::KeptVertices::noPressure ? noPressure : *name & 255);
			if (wide) *to++ = Byte(*name >> 8);
		}
		std::memcpy(to, kept.tight.data(), 4 * vertices);
		std::memcpy(to + 4 * vertices, kept.edge.data(), 4 * vertices);
	}

	void get(polytope::KeptVertices& kept) const
	{
		if (codes_.size() < header) return;
		const std::size_t planes = codes_[0], vertices = codes_[1];
		const bool        wide = codes_[3];
		if (planes > kept.plane.size() || vertices > kept.tight.size()
		        || codes_.size() != header + planes * (wide ? 2 : 1) + vertices * bytesOfVertex)
			return;
		kept.planes      = Byte(planes);
		kept.vertices    = Byte(vertices);
		kept.exchanged   = codes_[2] & 1;
		kept.shared      = codes_[2] >> 1;
		const Byte* from = codes_.data() + header;
		for (std::size_t k = 0; k < planes; ++k) {
			const int low = *from++;
			kept.plane[k] = std::uint16_t(wide  ? low | *from++ << 8
			                : low == noPressure ? int(polytope::KeptVertices::noPressure)
			                                    : low);
		}
		std::memcpy(kept.tight.data(), from, 4 * vertices);
		std::memcpy(kept.edge.data(), from + 4 * vertices, 4 * vertices);
	}

private:
	using Byte                                 = std::uint8_t;
	static constexpr int         noPressure    = 255;
	static constexpr std::size_t header        = 4;   ///< planes, vertices, shared and exchanged, and whether a plane has two bytes
	static constexpr std::size_t bytesOfVertex = 8;   ///< four planes, and two edges of two ends
	static constexpr std::size_t within        = 120; ///< of a contact of twelve vertices and a dozen planes, more than most have

	boost::container::small_vector<Byte, within> codes_;

	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		std::vector<Byte> codes(codes_.begin(), codes_.end());
		archive&          boost::serialization::make_nvp("codes", codes);
		codes_.assign(codes.begin(), codes.end());
	}
};

template <> struct SavedInPlace<StoredVertices> : std::true_type { };

} // namespace yade
