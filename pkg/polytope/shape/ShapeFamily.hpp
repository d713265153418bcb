// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/ForceContainer.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

#include <src/shape/ConvexShape.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What the stages of a simulation ask of a shape, whatever its class: one object for each class of shapes, registered once.
///
/// Sphere, Box, Facet, Wall and Polytope have theirs. A class without one of its own has that of the nearest of its bases that has, as
/// functors are found. A class derived from Polytope overrides functions of Polytope in place of it: margin(), and massProperties() and
/// surface() where these do not follow from the margin. A class of another base has a family, and
///
///     const FamilyOf<MyShape, MyFamily> family; // in the library that has MyShape, at namespace level
///
/// The functions of this class itself answer for a shape about which nothing is known. They are called by several threads at once, and must
/// not throw. Not asked here are other contacts, which have functors for each pair of classes, and boxes, which have bound functors
/// (FamilyBound.hpp has one by the bounding radius).
namespace yade {

using Planes = std::vector<polytope::Plane>; ///< world axes

/// A body as others of its kind continue it.
struct Solid {
	Planes      planes;
	std::size_t faces = 0; ///< the first so many; what follows are the upright sides of a facet, on which nothing can lie

	void clear()
	{
		planes.clear();
		faces = 0;
	}
};

/// Where a body stands, and who asks: world axes, from a point that the caller chooses.
struct Placing {
	Vector3r centre;
	Matrix3r rotation;
	Vector3r other; ///< centre of the body that meets it
	Real     near;  ///< bodies farther than this from the point do not matter [m]
};

/// A body as a core and a ball around each of its points: world axes. The core is half-spaces, or, without an interior, a segment or a point.
struct CoreOfBody {
	std::shared_ptr<const polytope::ConvexShape>
	         convex; ///< a polyhedron or a half-space; null: the segment from the origin along `way`
	Real     margin; ///< the ball's radius [m]
	Vector3r origin;
	Matrix3r rotation;
	Vector3r way = Vector3r::Zero(); ///< zero: the origin alone [m]
	/// States of the segment's ends, where these are bodies of their own that move it, as nodes do a beam; null: it moves as its body.
	const State *end1 = nullptr, *end2 = nullptr;
};

class ShapeFamily {
public:
	virtual ~ShapeFamily() = default;

	/// Radius of the ball about the body's centre that holds it [m]; 0: not known, or there is none.
	virtual Real boundingRadius(const Shape&) const { return 0; }

	/// Radius of the largest ball in it [m], of which a body may move a part in a time step; infinite: it limits no step.
	virtual Real inscribedRadius(const Shape&) const { return std::numeric_limits<Real>::infinity(); }

	/// What YADE's physics take for a sphere's radius [m] (ContactSizes.hpp); 0: as large as what it touches.
	virtual Real size(const Shape&) const { return 0; }

	/// Area that it shows in a direction of its own axes [m²]; 0: not known.
	virtual Real projectedArea(const Shape&, const Vector3r& /*direction*/) const { return 0; }

	/// Whether it is the same in all orientations: its box need not follow a rotation.
	virtual bool isRound(const Shape&) const { return false; }

	/// Enlarges a box by the body as it stands [m]. This class does it by the ball of the bounding radius.
	virtual void extend(const Shape& shape, const State& state, Vector3r& low, Vector3r& high) const;

	/// Appends its half-spaces as a piece of a support, as the other body meets it; none: it is not seen as one, so that what slides over
	/// several such bodies meets each alone.
	virtual void addSupport(const Shape&, const Placing&, Solid&) const { }

	/// What a PolytopeMarginFunctor (contact/MarginContact.hpp) meets, of a body in this place whose partner's centre is at `other`; none: it
	/// has no contact by it.
	virtual std::optional<CoreOfBody> core(
	        const Shape&, const Vector3r& /*position*/, const Quaternionr& /*orientation*/, const Vector3r& /*other*/) const
	{
		return std::nullopt;
	}

	/// Adds a contact's force [N], which acts at a place of the body, to what the scene sums for each body. This class adds it to the body,
	/// with its torque about the body's centre; the family of a body that others carry, as nodes do a beam, adds it to these. Laws ask it by
	/// addContactForce() (contact/ContactForce.hpp); those of the plug-in and YADE's do not.
	virtual void addForce(const Body& body, const Vector3r& place, const Vector3r& force, ForceContainer& forces) const;

	/// Faces to be drawn, in its own axes; null: none.
	virtual std::shared_ptr<const polytope::Polyhedron> surface(const Shape&) const { return nullptr; }
};

/// The family that is registered for this class, or for the nearest of its bases that has one.
const ShapeFamily& familyOf(const Shape& shape);

/// Why what its family says of a shape is no size: a radius or a margin that is no number or negative; empty: nothing. Stages ask for sizes
/// in parallel, and take what they get.
std::string faultOfFamily(const Shape& shape);

/// Registers a family; to be called before a scene has such a shape. \param classIndex YADE's, Shape::getClassIndex()
void registerFamily(int classIndex, std::unique_ptr<const ShapeFamily> family);

template <class Kind, class Family> struct FamilyOf {
	FamilyOf() { registerFamily(Kind().getClassIndex(), std::make_unique<Family>()); }
};

/// Enlarges a box by points in the axes of a body.
inline void extendBy(const std::vector<Vector3r>& points, const State& state, Vector3r& low, Vector3r& high)
{
	for (const Vector3r& point : points) {
		const Vector3r place = state.pos + state.ori * point;
		low                  = low.cwiseMin(place);
		high                 = high.cwiseMax(place);
	}
}

} // namespace yade
