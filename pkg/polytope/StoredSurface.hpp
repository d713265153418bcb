// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Seldom.hpp"

#include <src/surface/KeptSurface.hpp>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace yade {

/// A contact's polytope::KeptSurface with the numbers that it uses, in a byte each where they fit, as those of bodies with up to 127 planes do.
class StoredSurface {
public:
	/// Needs new memory only where there are more numbers than ever before.
	void set(const polytope::KeptSurface& kept)
	{
		if (kept.used == 0 && !codes_.get()) return;
		const auto begin = kept.number.begin(), end = begin + kept.used;
		const bool wide = std::any_of(begin, end, [](int number) { return number >= noPressure && number != Names::noPressure; });
		std::vector<Byte>& codes = codes_.make();
		codes.resize(header + std::size_t(kept.used) * (wide ? 2 : 1));
		codes[0] = kept.parts;
		codes[1] = kept.exchanged;
		codes[2] = wide;
		Byte* to = codes.data() + header;
		for (auto number = begin; number != end; ++number) {
			*to++ = Byte(!wide && *number == Names::noPressure ? noPressure : *number & 255);
			if (wide) *to++ = Byte(*number >> 8);
		}
	}

	void get(polytope::KeptSurface& kept) const
	{
		const std::vector<Byte>* const codes = codes_.get();
		if (!codes || codes->size() < header) return;
		const bool        wide = (*codes)[2];
		const std::size_t used = std::min((codes->size() - header) / (wide ? 2 : 1), kept.number.size());
		kept.parts             = (*codes)[0];
		kept.exchanged         = (*codes)[1];
		kept.used              = std::uint16_t(used);
		const Byte* from       = codes->data() + header;
		for (std::size_t k = 0; k < used; ++k) {
			const int low  = *from++;
			kept.number[k] = std::uint16_t(wide ? low | *from++ << 8 : low == noPressure ? int(Names::noPressure) : low);
		}
	}

private:
	using Byte                              = std::uint8_t;
	using Names                             = polytope::PlaneNames;
	static constexpr int         noPressure = 255;
	static constexpr std::size_t header     = 3; ///< parts, exchanged, and whether a number has two bytes

	Seldom<std::vector<Byte>> codes_;

	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		archive& boost::serialization::make_nvp("codes", codes_);
	}
};

template <> struct SavedInPlace<StoredSurface> : std::true_type { };

} // namespace yade
