// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/PlacedShape.hpp"
#include "timestep/StableTimeStep.hpp"

/// Rocking stiffness of a contact at the analytic centre, and of two faces with the contact model *spring*.
///
/// At the analytic centre: where two faces lie on each other, a tilt θ makes the overlap a wedge, and the analytic centre moves towards its
/// thick side. The centre x is where Σ a_i/σ_i = 0 over all planes of both bodies, σ_i = d_i − a_i·x their slacks. Turning body 2 by θ
/// about x leaves its slacks at x as they are and turns its normals, so with H = Σ a_i a_iᵀ/σ_i² and g = Σ over body 2 of a_i/σ_i
///
///     dx = −H⁻¹ (θ × g),    moment = normal force × |g| [n]× H⁻¹ [n]×ᵀ θ        (g is along −n).
///
/// For a square face of side L, whose four sides belong to one body, H = 8/L² across n and |g| = 2/depth: the rocking stiffness is
/// kₙ L²/4, three times that of springs spread over the face. For any contact it is at most kₙ × depth × |g| × (half the section's width)².
namespace polytope {

/// What the normal force of a contact depends on where the bodies tilt.
enum class FaceForce : int {
	AtCentre = 0, ///< the depth at the analytic centre
	Pressure,     ///< a pressure over the area, proportional to the depth
	Spring,       ///< the contact model *spring*
};

/// Rocking stiffness of two flush faces with the contact model *spring* over that of a pressure of the same stiffness over the area. A tilt makes the
/// depth h + δ with ∫ δ dA = 0; with V = ∫ h²/4 dA and W = ∫ h³/24 dA (SurfaceContact.hpp) the energy is ½ k (∫ h³/∫ h²)² = ½ k (h² + 4 ∫ δ² dA/A)
/// to second order: the pressure's has 1 for the 4.
constexpr int rockingOfSpring = 4;

/// Rocking stiffness of two flush faces over their normal stiffness [m²/rad], where the force is that of a pressure or of the contact model *spring*:
/// 1/A ∫ (r × n)(r × n)ᵀ dA, times rockingOfSpring for the latter. `meanSquare`: 1/A ∫ r rᵀ dA, r from the centre of the force.
inline Matrix3 rockingOfFaces(const Matrix3& meanSquare, const Vector3& normal, FaceForce force)
{
	const Matrix3 turn  = crossMatrix(normal);
	const Real    times = force == FaceForce::Spring ? rockingOfSpring : 1;
	return times * turn * meanSquare * turn.transpose();
}

/// Adds the planes of a body, its centre as seen from the contact point, to H, in the axes (t₁, t₂, n), and returns |Σ a_i/σ_i|. No slack is taken as smaller than `least`, the least
/// distance of the centre from any plane: in a scene far from its origin small slacks are dominated by rounding.
inline Real addPlanes(const PlacedShape& body, const Matrix3& axes, Real least, Matrix3& hessian)
{
	const HalfSpaces& planes = body.shape.planes();
	const Vector3     point  = -(body.rotation.transpose() * body.centre);
	const Matrix3     turn   = axes.transpose() * body.rotation;
	Vector3           pull   = Vector3::Zero();
	for (std::size_t i = 0; i < planes.size(); ++i) {
		const Real    slack  = planes.offsets[i] - planes.normals[i].dot(point);
		const Vector3 scaled = turn * planes.normals[i] / (slack > least ? slack : least);
		hessian += scaled * scaled.transpose();
		pull += scaled;
	}
	return pull.norm();
}

/// |g| [n]× H⁻¹ [n]×ᵀ [m/rad]: times the normal force, the rocking stiffness. Polygons turn about z alone.
inline Matrix3 rockingArms(const PlacedShape& body1, const PlacedShape& body2, const Vector3& normal, Real depth)
{
	const bool    flat  = body2.shape.dimension() == 2;
	const Vector3 aside = flat ? Vector3(0, 0, 1) : Vector3(abs(normal[0]) < Real(0.6) ? Vector3(1, 0, 0) : Vector3(0, 1, 0));
	Matrix3       axes;
	axes.col(0) = aside.cross(normal).normalized();
	axes.col(1) = normal.cross(axes.col(0));
	axes.col(2) = normal;

	const Real least   = depth / Real(body1.shape.planeCount() + body2.shape.planeCount());
	Matrix3    hessian = Matrix3::Zero();
	addPlanes(body1, axes, least, hessian);
	const Real pull = addPlanes(body2, axes, least, hessian);

	// across the normal; a section is not wider than the smaller body, so H is not below this either
	const Real radius
	        = body1.shape.boundingRadius() < body2.shape.boundingRadius() ? body1.shape.boundingRadius() : body2.shape.boundingRadius();
	const Real floor  = 1 / (radius * radius);
	const auto across = [&](int i, int j) { return hessian(i, j) - hessian(i, 2) * hessian(2, j) / hessian(2, 2); };
	const Real h00    = across(0, 0) > floor ? across(0, 0) : floor;
	if (flat) return pull / h00 * axes.col(1) * axes.col(1).transpose();
	const Real h11 = across(1, 1) > floor ? across(1, 1) : floor;
	Real       h01 = across(0, 1);
	if (!(h00 * h11 - h01 * h01 > floor * (h00 > h11 ? h00 : h11) / 4)) h01 = 0; // rounding of a section that is a line
	const Real determinant = h00 * h11 - h01 * h01;
	// n × t₁ = t₂ and n × t₂ = −t₁: a tilt about t₁ moves the point along t₂
	const Vector3 &t1 = axes.col(0), &t2 = axes.col(1);
	return pull / determinant
	        * (h11 * t2 * t2.transpose() + h00 * t1 * t1.transpose() + h01 * (t1 * t2.transpose() + t2 * t1.transpose()));
}

} // namespace polytope
