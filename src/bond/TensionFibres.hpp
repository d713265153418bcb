// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <vector>

/// The area of a joint as fibres of springs that give way in tension one by one.
///
/// A fibre that is opened by w has the stress k w in compression (w < 0), and in tension k (w − p) up to the strength; beyond, its lasting opening p
/// grows. While it closes again it bears nothing between p and 0: what has been torn apart presses only where it touches.
namespace polytope {

/// Small triangles per side of each of the triangles between the area's centroid and its edges.
constexpr int fibreTriangles = 4;

/// Calls visit(place, area, index) for fibres at the midpoints of the edges of small triangles, in which area and second moments are exact.
/// \param corners (0, y, z) of the area from its centroid, counter-clockwise about the normal
template <class Visit> void forFibres(const std::vector<Vector3>& corners, const Visit& visit)
{
	constexpr int n     = fibreTriangles;
	std::size_t   index = 0;
	for (std::size_t k = 0; k < corners.size(); ++k) {
		const Vector3 a = corners[k] / n, b = corners[(k + 1) % corners.size()] / n;
		const Real    part = (a[1] * b[2] - a[2] * b[1]) / 6; // a third of a small triangle
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n - i; ++j)
				for (int flipped = 0; flipped < (i + j < n - 1 ? 2 : 1); ++flipped) {
					const Real    turn   = flipped ? -1 : 1;
					const Vector3 corner = Real(i + flipped) * a + Real(j + flipped) * b;
					visit(corner + turn * a / 2, part, index++);
					visit(corner + turn * b / 2, part, index++);
					visit(corner + turn * (a + b) / 2, part, index++);
				}
	}
}

/// Number of them.
inline std::size_t fibreCount(std::size_t corners) { return corners * std::size_t(3 * fibreTriangles * fibreTriangles); }

/// Sums over all fibres: force, positive in tension; moments ∫ σ z dA and −∫ σ y dA, which go with the rotations θ₁ and θ₂ about the axes y and z.
struct FibreSum {
	Real force = 0, moment1 = 0, moment2 = 0; ///< [N], [N m]
	Real energy = 0;                          ///< stored [J]
	Real work   = 0;                          ///< taken by the lasting openings in this step [J]
};

/// Stresses of an opening d + θ₁ z − θ₂ y.
/// \param strength in tension [Pa]
/// \param lasting p of each fibre [m], which grow where the strength is reached
inline FibreSum fibreForces(const std::vector<Vector3>& corners, Real opening, Real rotation1, Real rotation2, Real stiffness,
        Real strength, std::vector<Real>& lasting)
{
	FibreSum sum;
	forFibres(corners, [&](const Vector3& place, Real area, std::size_t index) {
		const Real w      = opening + rotation1 * place[2] - rotation2 * place[1];
		Real&      p      = lasting[index];
		Real       stress = w < 0 ? stiffness * w : w > p ? Real(stiffness * (w - p)) : Real(0);
		if (stress > strength) {
			sum.work += area * strength * (stress - strength) / stiffness;
			p += (stress - strength) / stiffness;
			stress = strength;
		}
		sum.force += area * stress;
		sum.moment1 += area * stress * place[2];
		sum.moment2 -= area * stress * place[1];
		sum.energy += area * stress * stress / (2 * stiffness);
	});
	return sum;
}

} // namespace polytope
