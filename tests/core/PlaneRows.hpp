// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"
#include "program/PairPlanes.hpp"

#include <vector>

/// PairPlanes that own their memory, for tests of the kernel's stages one by one.
namespace polytope::samples {

template <class R, int D> class PlaneRows {
public:
	PairPlanes<R, D> planes;

	/// Both sets in the same frame, padded as the kernel pads them.
	PlaneRows(const HalfSpaces& set1, const HalfSpaces& set2)
	{
		const int padded[] = { paddedCount(set1), paddedCount(set2) };
		const int total    = padded[0] + padded[1];
		numbers_.assign(std::size_t(D + 3) * total, R(0));
		for (int k = 0; k < D; ++k)
			planes.normal[k] = numbers_.data() + k * total;
		planes.offset = numbers_.data() + D * total;
		planes.slack  = planes.offset + total;
		planes.rate   = planes.slack + total;
		planes.first  = padded[0];
		planes.total  = total;
		for (int i = 0; i < total; ++i)
			planes.offset[i] = R(padOffset);
		fill(set1, 0);
		fill(set2, padded[0]);
	}
	PlaneRows(const PlaneRows&) = delete;

	/// Row of plane `index` of a body.
	int row(int body, int index) const { return planes.begin(body) + index; }

private:
	std::vector<R> numbers_;

	static int paddedCount(const HalfSpaces& set) { return (int(set.size()) + padWidth - 1) / padWidth * padWidth; }

	void fill(const HalfSpaces& set, int begin)
	{
		for (std::size_t i = 0; i < set.size(); ++i) {
			for (int k = 0; k < D; ++k)
				planes.normal[k][begin + int(i)] = R(set.normals[i][k]);
			planes.offset[begin + int(i)] = R(set.offsets[i]);
		}
	}
};

/// Both bodies' planes of a pair in world axes from body 1's centre.
inline HalfSpaces worldPlanes(const Pair& pair, int body)
{
	return moved(pair.shape[body]->planes(), pair.rotation[body], body == 0 ? Vector3(Vector3::Zero()) : pair.centre2);
}

inline Vector3 vectorOf(const Real* x, int dimension) { return { x[0], x[1], dimension == 3 ? x[2] : Real(0) }; }

} // namespace polytope::samples
