// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/RegularSolids.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace polytope {

HalfSpaces regularSolid(int faces, Real circumradius)
{
	using std::isfinite;
	using std::sqrt;
	if (!(circumradius > 0) || !isfinite(circumradius)) throw std::invalid_argument("circumradius: must be positive and finite");
	const Real golden = (1 + sqrt(Real(5))) / 2;

	// face normals before normalisation (the vertices of the dual solid), and inradius/circumradius
	HalfSpaces set;
	Real       ratio = 0;
	const auto add   = [&](Real x, Real y, Real z) { set.normals.emplace_back(x, y, z); };
	// (±x, ±y, ±z), each sign once per non-zero component
	const auto addSigned = [&](Real x, Real y, Real z) {
		for (int sx = x != 0 ? -1 : 1; sx <= 1; sx += 2)
			for (int sy = y != 0 ? -1 : 1; sy <= 1; sy += 2)
				for (int sz = z != 0 ? -1 : 1; sz <= 1; sz += 2)
					add(sx * x, sy * y, sz * z);
	};
	switch (faces) {
		case 4:
			add(1, 1, 1), add(1, -1, -1), add(-1, 1, -1), add(-1, -1, 1);
			ratio = Real(1) / 3;
			break;
		case 6:
			addSigned(1, 0, 0), addSigned(0, 1, 0), addSigned(0, 0, 1);
			ratio = 1 / sqrt(Real(3));
			break;
		case 8:
			addSigned(1, 1, 1);
			ratio = 1 / sqrt(Real(3));
			break;
		case 12:
			addSigned(0, 1, golden), addSigned(1, golden, 0), addSigned(golden, 0, 1);
			ratio = sqrt((5 + 2 * sqrt(Real(5))) / 15);
			break;
		case 20:
			addSigned(1, 1, 1), addSigned(0, 1 / golden, golden), addSigned(1 / golden, golden, 0),
			        addSigned(golden, 0, 1 / golden);
			ratio = sqrt((5 + 2 * sqrt(Real(5))) / 15);
			break;
		default:
			throw std::invalid_argument(
			        "faces: a regular polyhedron has 4, 6, 8, 12 or 20 faces, not " + std::to_string(faces));
	}
	set.offsets.assign(set.normals.size(), ratio * circumradius);
	for (Vector3& n : set.normals)
		n.normalize();
	return set;
}

} // namespace polytope
