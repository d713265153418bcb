// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/PlacedPair.hpp"

/// A contact in the neighbourhood of the pose in which it was computed, to first order in the bodies' motion since.
///
/// In a settled mass bodies move in a step by a millionth of the contacts' depth. Their force and moment are then those of the last full computation plus
/// their derivative (SurfaceStiffness.hpp) times the motion; what is left out is of the order of the square of motion over depth, tolerance::linearAcross²
/// at the most. The energy goes with them to second order, so that the force is its gradient between two full computations, and at one of them it
/// steps by tolerance::linearAcross³.
namespace polytope {

/// Where the outline over which friction acts has gone in a step, in the plane of the contact: about the contact point by an angle, and then by `shift`.
struct OutlineMotion {
	Real    cosine = 1, sine = 0;
	Vector2 shift = Vector2::Zero();

	Vector2 moved(const Vector2& corner) const
	{
		return Vector2(cosine * corner[0] - sine * corner[1] + shift[0], sine * corner[0] + cosine * corner[1] + shift[1]);
	}
};

/// Values, no pointers: copied and saved with the interaction. `First` and `second` are the bodies in the kernel's order (PairOrder.hpp).
struct LinearContact {
	bool known     = false;
	bool exchanged = false; ///< the kernel's first body is the caller's second
	bool perArea   = false; ///< foundation
	bool carrier   = false; ///< the body that takes the outline along, the smaller one: the caller's second

	// at the last full computation
	std::array<Real, 9> pose {}; ///< rotation of the second body in the first's axes, rows
	std::array<Real, 6>
	        load {};     ///< SurfaceLoad's force and, over the radius, moment, in the first body's axes and about the contact point
	Real    energy = -1; ///< SurfaceLoad's
	Real    area   = 0;  ///< [m²]
	Real    radius = 0;  ///< of the surface about the contact point [m]
	Real    across = 0;  ///< how far the bodies may have moved since, along the normal anywhere on the surface [m]
	Real    along  = 0;  ///< and along the surface
	Real    unit   = 0;  ///< of the derivative
	std::array<float, 36> slope {}; ///< derivative of load by the motion, rotations times the radius; a column for each motion
	std::array<Real, 2>   sizes {}; ///< of both shapes, by which a shape that was exchanged shows

	// at the last step: the contact's frame in the axes of the body that carries the outline
	Vector3 axis  = Vector3::Zero(); ///< first of PlaneAxes
	Vector3 place = Vector3::Zero(); ///< contact point, from where the body has taken that of the last full computation

	/// What a shape that was exchanged is noticed by.
	static Real sizeOf(const ConvexShape& shape) { return shape.boundingRadius() + 3 * shape.inscribedRadius(); }

	/// The contact in this step. False if it must be computed in full: the bodies have moved too far, or what is asked for is not known. `point`: that
	/// of the last full computation, in the caller's bodies' frames.
	POLYTOPE_API bool follow(const PlacedPair& pair, const ContactOptions& options, const Vector3& point1, const Vector3& point2,
	        ContactResult& result, OutlineMotion& outline);

	/// After a full computation: what follow() moves. Unknown where the derivative is no number, or vanishes. The caller sets energy, unit of the stiffness and
	/// carrier.
	///
	/// \param first       rotations of both bodies, in the kernel's order
	/// \param present     `load`
	/// \param derivative  of it by the motion, as `slope` has it: a column for each motion
	/// \param depth       −s*
	/// \param width       of the surface, over which the bodies may move along it
	void keep(const Matrix3& first, const Matrix3& second, const std::array<Real, 6>& present, const Real (&derivative)[6][6],
	        const Real& depth, const Real& areaOfSurface, const Real& radiusOfSurface, const Real& width);

	/// After the query: the bodies' order, and the frame of the caller's contact.
	void begin(const PlacedPair& pair, bool exchangedBodies, const ContactResult& result);

	/// Whether bodies that move in a step by this at the contact point, and turn by this against each other, will be near for so many steps. `depth`: −s*;
	/// `width`: of the surface, about.
	static bool isSlow(
	        int steps, const Real& depth, const Real& width, const Vector3& normal, const Vector3& motion, const Vector3& turn);

	template <class Visitor> friend void visitParts(LinearContact& linear, Visitor&& visit)
	{
		visit("known", linear.known);
		visit("exchanged", linear.exchanged);
		visit("perArea", linear.perArea);
		visit("carrier", linear.carrier);
		visit("pose", linear.pose);
		visit("load", linear.load);
		visit("energy", linear.energy);
		visit("area", linear.area);
		visit("radius", linear.radius);
		visit("across", linear.across);
		visit("along", linear.along);
		visit("unit", linear.unit);
		visit("slope", linear.slope);
		visit("sizes", linear.sizes);
		visit("axis", linear.axis);
		visit("place", linear.place);
	}
};

} // namespace polytope
