// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/FlatArchive.hpp"

#include <src/surface/KeptVertices.hpp>

#include <boost/container/small_vector.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <array>
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
		const std::size_t planes = kept.planes;
		const auto        begin = kept.plane.begin(), end = begin + planes;
		const bool        isWide = std::any_of(
                        begin, end, [](int name) { return name >= noPressure && name != polytope::KeptVertices::noPressure; });
		const int flags = (kept.exchanged ? exchanged : 0) | (isWide ? wide : 0) | (kept.shared ? shared : 0)
		        | (kept.ofEnergy ? ofEnergy : 0);
		const std::array<Byte, header> first { { kept.planes, kept.vertices, Byte(flags), kept.bytesOfPieces } };
		codes_.resize(sizeFor(first), boost::container::default_init);
		Byte*      to         = codes_.data();
		const auto writeBytes = [&to](const void* from, std::size_t bytes) {
			std::memcpy(to, from, bytes);
			to += bytes;
		};
		writeBytes(first.data(), header);
		if (kept.shared) writeBytes(&kept.shared, sizeof kept.shared);
		for (auto name = begin; name != end; ++name) {
			*to++ = Byte(!isWide && *name == polytope::KeptVertices::noPressure ? noPressure : *name & 255);
			if (isWide) *to++ = Byte(*name >> 8);
		}
		writeBytes(kept.tight.data(), 4 * std::size_t(kept.vertices));
		writeBytes(kept.piece.data(), kept.bytesOfPieces);
	}

	void get(polytope::KeptVertices& kept) const
	{
		if (codes_.size() < header || codes_.size() != sizeFor(codes_) || codes_[0] > kept.plane.size()
		        || codes_[1] > kept.tight.size())
			return;
		kept.planes        = codes_[0];
		kept.vertices      = codes_[1];
		kept.exchanged     = has(exchanged);
		kept.bytesOfPieces = codes_[3];
		kept.ofEnergy      = has(ofEnergy);
		kept.shared        = 0;
		const Byte* from   = codes_.data() + header;
		const auto  take   = [&from](void* to, std::size_t bytes) {
                        std::memcpy(to, from, bytes);
                        from += bytes;
		};
		if (has(shared)) take(&kept.shared, sizeof kept.shared);
		for (std::size_t k = 0; k < kept.planes; ++k) {
			const int low = *from++;
			kept.plane[k] = std::uint16_t(has(wide) ? low | *from++ << 8
			                : low == noPressure     ? int(polytope::KeptVertices::noPressure)
			                                        : low);
		}
		take(kept.tight.data(), 4 * std::size_t(kept.vertices));
		take(kept.piece.data(), kept.bytesOfPieces);
	}

	/// Whether these have pieces that are not stored.
	bool lacksPiecesOf(const polytope::KeptVertices& kept) const
	{
		return codes_.size() >= header && kept.bytesOfPieces > 0
		        && (codes_[3] != kept.bytesOfPieces || has(ofEnergy) != kept.ofEnergy);
	}

private:
	using Byte                      = std::uint8_t;
	static constexpr int noPressure = 255;
	enum Flag { exchanged = 1, wide = 2, shared = 4, ofEnergy = 8 };
	static constexpr std::size_t header = 4;   ///< planes, vertices, flags (wide: a plane has two bytes), bytes of the pieces
	static constexpr std::size_t within = 184; ///< of a face on a face, more than most have

	bool has(Flag flag) const { return (codes_[2] & flag) != 0; }

	template <class Codes> static std::size_t sizeFor(const Codes& codes)
	{
		const std::size_t names = (codes[2] & wide ? 2 : 1) * std::size_t(codes[0]), vertices = 4 * std::size_t(codes[1]);
		return header + (codes[2] & shared ? sizeof(polytope::KeptVertices::shared) : 0) + names + vertices + codes[3];
	}

	boost::container::small_vector<Byte, within> codes_;

	/// The pieces are not saved: those of a file would not be safe.
	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		std::vector<Byte> codes(codes_.begin(), codes_.end());
		if (codes.size() > header && Archive::is_saving::value) {
			codes.resize(codes.size() - codes[3]);
			codes[3] = 0;
		}
		archive& boost::serialization::make_nvp("codes", codes);
		if (!Archive::is_loading::value) return;
		if (codes.size() > header && codes[3] != 0) codes.clear();
		codes_.assign(codes.begin(), codes.end());
	}
};

template <> struct SavedInPlace<StoredVertices> : std::true_type { };

} // namespace yade
