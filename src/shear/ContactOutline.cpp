// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ContactOutline.hpp"

namespace polytope {

OutlineMoments momentsOf(const Vector2* corner, int count)
{
	OutlineMoments moments;
	if (count < 3) return moments;
	// from the first corner: an outline may be far from the contact point for its size
	Vector2 first  = Vector2::Zero();
	Real    raw[3] = { 0, 0, 0 };
	for (int k = 1; k + 1 < count; ++k) {
		const Vector2 a = corner[k] - corner[0], b = corner[k + 1] - corner[0], sum = a + b;
		const Real    twice = cross(a, b);
		moments.area += twice / 2;
		first += twice / 6 * sum;
		for (int m = 0; m < 3; ++m) {
			const int i = m / 2, j = (m + 1) / 2;
			raw[m] += twice / 24 * (a[i] * a[j] + b[i] * b[j] + sum[i] * sum[j]);
		}
	}
	if (!(moments.area > 0)) return OutlineMoments();
	const Vector2 from = first / moments.area;
	moments.centroid   = corner[0] + from;
	for (int m = 0; m < 3; ++m)
		moments.second[m] = raw[m] - moments.area * from[m / 2] * from[(m + 1) / 2];
	for (int m = 0; m < 3; m += 2)
		if (moments.second[m] < 0) moments.second[m] = 0; // rounding of a sliver
	return moments;
}

} // namespace polytope
