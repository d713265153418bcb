// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/FlatArchive.hpp"

#include <core/Aabb.hpp>
#include <core/Dispatching.hpp>
#include <core/Shape.hpp>

#include <src/shape/ConvexShape.hpp>

#include <optional>

namespace yade {

class Polytope : public Shape {
public:
	virtual ~Polytope() = default;

	/// Validates and builds; on bad input throws std::invalid_argument naming the argument and leaves the shape as it was.
	void postLoad(Polytope&);

	/// In YADE's 150-digit build the numbers of a list are written to binary archives as their memory image, which is an address:
	/// there the planes go into archives as text.
	static constexpr bool planesAsText = std::numeric_limits<Real>::digits > 113;
	/// Planes are in archives, as attributes; in memory the shape alone has them.
	void preSave(Polytope&);
	void postSave(Polytope&);
	/// The planes for pickling, which takes attributes from here.
	boost::python::dict pyDictCustom() const override;

	/// A Polytope with a shape that is built already: nothing is constructed. Refuses what postLoad() refuses.
	static shared_ptr<Polytope> of(const std::shared_ptr<const polytope::ConvexShape>& convex);

	/// Null until planes are given.
	const std::shared_ptr<const polytope::ConvexShape>& convex() const { return convex_; }

	/// How far the surface lies outside of the planes, everywhere [m]: 0 for this class; a class derived from it that is its planes and a
	/// ball, as rounded polyhedra are, returns the ball's radius. Boxes, sizes and PolytopeCollider, which leaves out pairs by their planes,
	/// add it. Without a value: the surface is not known by the planes, as that of a derived class that does not say; then no pair is left out
	/// by them, and the class has a bound functor of its own.
	virtual std::optional<Real> margin() const;

	/// Mass properties for unit density, in the body's frame, whose origin and axes they must be. This class gives those of the planes, with a
	/// margin those of the planes and a ball (RoundedSolid.hpp).
	virtual polytope::MassProperties massProperties() const;

	/// Faces to be drawn, in the body's frame. This class gives those of the planes, with a margin those of the planes and a ball. Null until planes are
	/// given.
	virtual std::shared_ptr<const polytope::Polyhedron> surface() const;

	/// Takes planes that are built already, in a class derived from it, too; refuses a corner radius that leaves no inner particle.
	void take(const std::shared_ptr<const polytope::ConvexShape>& convex);

	/// Why the body's frame is none of centroid and principal axes; empty if it is.
	std::string faultOfFrame() const;

	vector<Vector3r>    unitNormals() const;
	vector<Real>        planeOffsets() const;
	Real                volume() const;
	Vector3r            inertia() const;
	vector<Vector3r>    vertices() const;
	boost::python::list faces() const;
	Real                inscribedRadius() const;
	Real                circumscribedRadius() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Polytope, Shape,
	R"""(Convex polyhedron (or, with :yref:`dimension<Polytope.dimension>` 2, convex polygon) given by half-spaces $\vec a_i\cdot\vec x\le d_i$ in
the body's frame, whose origin is the centroid and whose axes are the principal axes of inertia [Boon2012]_. Usually made by the functions of the
module ``yade.polytope`` (*regular*, *cuboid*, *fromHalfSpaces*, *fromVertices*, *fromMesh*, *polygon*), which also set mass, inertia, position and
orientation of the body. Planes cannot be changed after construction (mass and inertia would no longer fit): make a new shape.

A plane that repeats another one to rounding is dropped. Planes that own no face are kept, since each one weighs in the analytic centre [Boon2012]_
(section 2.2), and in the other contact points' normals too: planes through all edges and vertices of two cubes turn the contact normal by up to 10°
and change the force by half of its mean (``./run accuracy --only path``). Leave out what the body does not need: *fromHalfSpaces* with
*keepRedundant=False* does; *fromVertices* and *fromMesh* make no such planes.)""",
		((vector<Vector3r>, normals, , (Attr::readonly | Attr::hidden | planesAsText * Attr::noSave),
		        "Normals of the planes while they are given, saved or loaded; otherwise empty: the shape has them once for all bodies"))
		((vector<Real>, offsets, , (Attr::readonly | Attr::hidden | planesAsText * Attr::noSave), "Offsets of the planes, while normals are there"))
		((string, planesText, , (Attr::readonly | Attr::hidden), "Normals and offsets in an archive, where they are no lists there"))
		((Real, cornerRadius, 0, Attr::triggerPostLoad, "Radius $r$ [m] with which corners of the inner potential particle are rounded; the "
		        "normal of the contact model *boon2012* (:yref:`contactModel<Ig2_Polytope_Polytope_PolytopeGeom.contactModel>`) is the "
		        "gradient of this particle (Eqs 13-17 of [Boon2012]_); the other models do not read it. At least 0 and smaller than "
		        ":yref:`inscribedRadius<Polytope.inscribedRadius>`. Where the contact point lies deeper than $r$ in a body, that body gives "
		        "no normal, see :yref:`PolytopeGeom.status`."))
		((vector<int>, faceMaterials, , , "Index in O.materials of the material of each face's joint, one for each of "
		        ":yref:`normals<Polytope.normals>`, -1: the body's; empty: that of all. :yref:`Ip2_RockJointMat_RockJointMat_RockJointPhys` "
		        "gives a contact the strength of the face that it lies on. *JointedRock.append* sets it."))
		((int, dimension, 3, Attr::readonly, "3: polyhedron. 2: polygon in the $xy$ plane (normals without $z$ component), a prism of "
		        ":yref:`thickness<Polytope.thickness>` for mass and drawing; contacts are solved in two dimensions. Polygons meet polygons "
		        "only."))
		((Real, thickness, 1, Attr::readonly, "Extent along $z$ of a polygon [m]; multiplies contact lengths to areas. Unused for "
		        "polyhedra."))
		, /*ctor*/ createIndex();
		, /*py*/
		.add_property("normals", &Polytope::unitNormals, "Unit outward normals $\\vec a_i$ in the body's frame [-]. Given with any length, "
		        "they are normalised together with :yref:`offsets<Polytope.offsets>`, and repeated ones dropped.")
		.add_property("offsets", &Polytope::planeOffsets, "Offsets $d_i$ of the half-spaces $\\vec a_i\\cdot\\vec x\\le d_i$ [m].")
		.add_property("volume", &Polytope::volume, "Volume [m³], with a margin if the class has one.")
		.add_property("inertia", &Polytope::inertia, "Principal moments of inertia about the centroid per unit density [m⁵]: multiply by "
		        "the density for *state.inertia*.")
		.add_property("vertices", &Polytope::vertices, "Vertices in the body's frame [m]; for drawing and bounding boxes, contacts do not "
		        "use them.")
		.add_property("faces", &Polytope::faces, "Faces as lists of indices into :yref:`vertices<Polytope.vertices>`, counter-clockwise "
		        "seen from outside.")
		.add_property("inscribedRadius", &Polytope::inscribedRadius, "Radius of the largest inscribed ball (disc for polygons) [m].")
		.add_property("circumscribedRadius", &Polytope::circumscribedRadius, "Distance of the farthest vertex from the centroid (polygons: "
		        "in their plane) [m].")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(Polytope, Shape);

private:
	std::shared_ptr<const polytope::ConvexShape> convex_;

	void adopt(const std::shared_ptr<const polytope::ConvexShape>& convex);
	void forgetPlanes();
};
REGISTER_SERIALIZABLE(Polytope);

} // namespace yade

POLYTOPE_SAVED_FLAT(Polytope)

namespace yade {

/// Whether the body may rotate before its box is computed again.
bool mayTurn(const Body* body);

class Bo1_Polytope_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*) override;

	/// The displacement of the farthest vertex by rotation that the box of a body allows for, by body id: set by a collider that follows rotation
	/// (PolytopeCollider), while it runs.
	const std::vector<Real>* rooms = nullptr;

	FUNCTOR1D(Polytope);
	// clang-format off
	YADE_CLASS_BASE_DOC(Bo1_Polytope_Aabb, BoundFunctor, "Creates or updates the :yref:`Aabb` of a :yref:`Polytope`, exact in sheared periodic "
	        "cells too. For a :yref:`PolytopeCollider` it is the tight box of the vertices, enlarged for rotation. "
	        ":yref:`InsertionSortCollider` with :yref:`verletDist<InsertionSortCollider.verletDist>` above 0 computes boxes again only after a "
	        "translation, and a body that rotates in place would leave a tight one unnoticed: with this collider a body that can turn gets the "
	        "box of its circumscribed ball (disc), one that cannot (rotations blocked and *angVel* zero) the tight one. Set the *angVel* of a "
	        "body turned by the script before the run then.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Bo1_Polytope_Aabb);

} // namespace yade
