// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/LpBasis.hpp"
#include "shape/MassProperties.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace polytope {

/// A validated convex particle in its body frame, immutable: what the contact path reads (padded plane arrays, inscribed
/// ball) and what everything else reads (vertices, faces, mass properties). Bodies of equal planes share one.
class POLYTOPE_API ConvexShape {
public:
	/// Refuses (std::invalid_argument naming `normals`, `offsets`, `dimension`, `thickness` or `cornerRadius`) everything
	/// normalised() and polyhedron() refuse, and a cornerRadius that is negative, not finite, or not smaller than
	/// boundingRadius(). From inscribedRadius() on the inner particle is empty, but its gradient, all that a contact uses,
	/// has a direction at every depth. Planes are kept as given, redundant ones and repeated ones too, since each one
	/// weighs in the analytic centre; withoutDuplicates() and withoutRedundant() are the caller's (ShapeFactory.hpp).
	ConvexShape(const HalfSpaces& planes, Real cornerRadius, Real thickness = 1);

	/// The shared instance for these arguments; builds it only if no body has one. Thread-safe.
	static std::shared_ptr<const ConvexShape> shared(const HalfSpaces& planes, Real cornerRadius, Real thickness = 1);

	/// The shared instance of planes whose faces and approximate vertices are known: nothing is computed again. Without a corner
	/// radius, `cornerFraction` of the inscribed ball's. For ShapeFactory.
	static std::shared_ptr<const ConvexShape> ofFaces(const HalfSpaces& planes, Polyhedron faces,
	        const std::optional<Real>& cornerRadius, const Real& cornerFraction, const Real& thickness);

	/// The shared instance of this shape with another corner radius, on which nothing else depends.
	std::shared_ptr<const ConvexShape> withCornerRadius(const Real& radius) const;

	/// The half-space normal·x ≤ 0 alone (an infinite wall): no vertices, no volume, infinite radii. It can meet a bounded shape, not another
	/// half-space. Its gradient is its own normal at any depth. The normal's length is a precondition of queries (contact/Preconditions.hpp).
	static std::shared_ptr<const ConvexShape> halfSpace(const Vector3& unitNormal, int dimension);

	int  dimension() const { return planes_.dimension; }
	int  planeCount() const { return int(planes_.size()); }
	int  paddedCount() const { return padded_; }
	Real cornerRadius() const { return cornerRadius_; }
	Real thickness() const { return thickness_; }

	/// Component k of all unit normals, or all offsets, padded to a multiple of padWidth with neutral planes.
	const Real* normalArray(int k) const { return arrays_.data() + k * padded_; }
	const Real* offsetArray() const { return arrays_.data() + dimension() * padded_; }

	/// Largest inscribed ball (disc in 2-D) and the dimension + 1 planes that bound it: a basis of the phase-one LP that is
	/// dual feasible whatever the other body does.
	Real                      inscribedRadius() const { return inscribedRadius_; }
	const std::array<int, 4>& inscribedBasis() const { return inscribedBasis_; }
	/// The inscribed ball's basis, solved in the body's axes; null where it has too few digits (planes nearly parallel), and for a half-space.
	template <int D> const LpBasis<Real, D>* inscribedBall() const
	{
		const auto& ball = std::get<std::optional<LpBasis<Real, D>>>(inscribedBall_);
		return ball ? &*ball : nullptr;
	}

	/// Radius of the smallest ball about the body's origin that holds it.
	Real boundingRadius() const { return boundingRadius_; }

	/// The vertex that is farthest along a direction of the body's axes (any length). Not of a half-space, which has none.
	const Vector3& support(const Vector3& direction) const;

	/// Extent along a unit vector of the body's axes; infinite for a half-space.
	Real widthAlong(const Vector3& direction) const;

	const HalfSpaces&     planes() const { return planes_; }
	const Polyhedron&     polyhedron() const { return polyhedron_; }
	const MassProperties& mass() const { return mass_; }

private:
	ConvexShape() = default; // for halfSpace
	ConvexShape(const HalfSpaces& unit, Polyhedron faces, const Real& thickness);
	void                                      fillArrays();
	void                                      roundCorners(const Real& radius);
	static std::shared_ptr<const ConvexShape> known(std::shared_ptr<const ConvexShape> shape);

	HalfSpaces         planes_;
	Real               cornerRadius_ = 0;
	Real               thickness_    = 1;
	Polyhedron         polyhedron_;
	MassProperties     mass_;
	int                padded_ = 0;
	std::vector<Real>  arrays_;
	Real               inscribedRadius_ = 0;
	Real               boundingRadius_  = 0;
	std::array<int, 4> inscribedBasis_ { { 0, 0, 0, 0 } };

	std::pair<std::optional<LpBasis<Real, 2>>, std::optional<LpBasis<Real, 3>>> inscribedBall_; ///< of the shape's dimension
};

} // namespace polytope
