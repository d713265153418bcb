// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/StoredOutline.hpp"
#include "contact/StoredVertices.hpp"
#include "host/FlatArchive.hpp"
#include "host/Seldom.hpp"
#include "material/StiffnessRules.hpp"

#include <pkg/dem/ScGeom.hpp>

#include <src/contact/ContactQuery.hpp>
#include <src/contact/LinearContact.hpp>
#include <src/timestep/RockingStiffness.hpp>

#include <boost/serialization/array.hpp>

#include <array>
#include <cstdint>

namespace yade {

/// Half-spaces that represent YADE's own shape in a mixed pair (MixedPairs.hpp), and a facet's side.
struct StandIn {
	std::shared_ptr<const polytope::ConvexShape> partner;
	int                                          side = 0;
};

/// Normal law of a joint that stiffens as it closes, by which its force and energy depend on the surface.
struct ClosureOfJoint {
	polytope::ClosureLaw law;

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		visitParts(law, [&](const char* name, auto& value) { archive& boost::serialization::make_nvp(name, value); });
	}
};

/// By how much the dilation of its joint holds the bodies of a contact apart [m].
struct WideningOfJoint {
	Real present = 0; ///< for which the contact was found in this step
	Real next    = 0;

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		archive& boost::serialization::make_nvp("present", present);
		archive& boost::serialization::make_nvp("next", next);
	}
};

/// What gives a contact whose bodies hardly move.
struct LinearOfContact {
	polytope::LinearContact linear;

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		visitParts(linear, [&](const char* name, auto& value) { archive& boost::serialization::make_nvp(name, value); });
	}
};

/// There is one for each contact, so what few contacts have is apart (Seldom) and small numbers lie next to each other.
class PolytopeGeom : public ScGeom {
public:
	virtual ~PolytopeGeom() = default;

	/// Codes of planes (src/program/PlaneCode.hpp): those of a basis, and of others.
	using BasisCodes = std::array<std::uint16_t, 4>;
	using PlaneCodes = Seldom<std::vector<int>>;
	/// The radii about both bodies, and five numbers for each plane: its body, normal and offset.
	using PlaneEnds = Seldom<std::vector<Real>>;
	using Closure   = Seldom<ClosureOfJoint>;
	using Linear    = Seldom<LinearOfContact>;
	using Widening  = Seldom<WideningOfJoint>;

	/// What a contact that is followed (FollowedContact.hpp) reads in each step: all but `surface`, which is last.
	static std::size_t bytesOfEachStep() { return sizeof(PolytopeGeom) - sizeof(StoredVertices); }

	/// Made when first needed; not saved.
	Seldom<StandIn> standIn;

	polytope::PairMemory memory() const;
	/// A basis of planes beyond the 32767th is not kept: the next step starts without one. `sameSurface`: the vertices are those known.
	void remember(const polytope::PairMemory& memory, bool sameSurface = false);
	/// Planes that neighbours cover (InternalFaces.hpp), as internalFaces has them.
	polytope::InternalPlanes internalPlanes() const;
	void                     setInternalPlanes(const polytope::InternalPlanes& planes);
	/// Corners of the outline in the world.
	std::vector<Vector3r> cornersOfOutline() const;
	boost::python::list   outlineCorners() const;
	/// The joint acts as a bond of its faces in this step (RockJointBond.cpp). This is the law's only value in a geometry: until the next query
	/// all who ask a contact where its force acts, and with what energy (window, files, arrays, time step), have the bond's answer. Depth, area and
	/// status stay the overlap's.
	void actAsBond(const Vector3r& bondNormal, const Vector3r& bondPoint, Real bondEnergyPerStiffness)
	{
		normal             = bondNormal;
		contactPoint       = bondPoint;
		energyPerStiffness = bondEnergyPerStiffness;
	}
	/// The law's dilation, from the next step on: the contact is that of bodies which are nearer by it, so that pressure, area and point are those of the
	/// springs between faces that dilation holds apart.
	void widenBy(Real dilation)
	{
		if (dilation > 0 || widened.get()) widened.make().next = dilation;
	}
	Real widening() const { return widened.get() ? widened.get()->present : Real(0); }
	/// How far the joint is closed: the bodies' overlap, and what its dilation adds to it [m].
	Real closedBy() const { return penetrationDepth + widening(); }
	/// Whether it is. The area of a pair that the query found apart is that of grown bodies.
	bool                touches() const { return closedBy() > 0 && statusCode != int(polytope::ContactStatus::Separated); }
	polytope::FaceForce faceForce() const { return polytope::FaceForce(faceForceCode); }
	std::string         statusText() const { return polytope::statusName(polytope::ContactStatus(statusCode)); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeGeom, ScGeom,
	R"""(Geometry of one contact of a :yref:`Polytope` [Boon2012]_: point, :yref:`normal<GenericSpheresContact.normal>` (from body 1 to body 2),
:yref:`penetrationDepth<ScGeom.penetrationDepth>` and :yref:`contactArea<PolytopeGeom.contactArea>` by the
:yref:`contactModel<Ig2_Polytope_Polytope_PolytopeGeom.contactModel>`. Models with a surface: a force of stiffness times depth (per area: times area,
too) along the normal through the point is the gradient of an elastic energy; on faces its point is the centre of the pressure
(docs/contact-force.md). While a rock joint acts as a bond (:yref:`RockJointPhys.bond`), its law writes the bond's normal, point and
:yref:`energyPerStiffness<PolytopeGeom.energyPerStiffness>` in place of the overlap's. Being a :yref:`ScGeom`, it works with every ``Law2_ScGeom_*``
(with *sphericalBodies* = False for :yref:`Law2_ScGeom_FrictPhys_CundallStrack`) and with :yref:`GlobalStiffnessTimeStepper` (whose
:yref:`defaultDt<GlobalStiffnessTimeStepper.defaultDt>` must be set, to 0.2 $\\sqrt{m/k_n}$ or so: until the first contact it takes the step of a
P-wave, which YADE knows for spheres only); :yref:`refR1<GenericSpheresContact.refR1>` and *refR2*, which YADE's physics take their stiffness from,
are the bodies' sizes when the contact began: half the edge of the cube (polygons: square) of the same volume (area), a sphere's radius; a wall, a
box, a facet and a body that cannot move count as large as the other body.)""",
		((Real, infeasibility, 0, Attr::readonly, "Optimum $s^*$ of the phase-one linear program [m]: minus the radius of the largest ball "
		        "in the overlap; positive for a gap (for a pair dismissed early, a lower bound). Of a contact that is followed "
		        "(docs/contact-surface.md) that of its last full computation."))
		((Real, contactArea, 0, Attr::readonly, "Area of the contact surface as seen along the normal, or, with *boon2012*, area in "
		        "which the plane through the contact point, normal to the contact normal, cuts both bodies [m²]; polygons: length times "
		        "thickness. With *boon2012* computed where a law needs it, as those of rock joints do, or if "
		        ":yref:`computeArea<Ig2_Polytope_Polytope_PolytopeGeom.computeArea>` is set."))
		((std::int8_t, statusCode, 0, (Attr::readonly | Attr::hidden), "Outcome of the last query as a number"))
		((bool, hasBasis, false, (Attr::readonly | Attr::hidden), "Whether the basis is known"))
		((bool, hasPoint, false, (Attr::readonly | Attr::hidden), "Whether the points are known"))
		((bool, needsArea, false, Attr::readonly, "Whether this contact's physics use :yref:`contactArea<PolytopeGeom.contactArea>`, as "
		        "those of rock joints do; set when they are made."))
		((bool, atOnePoint, false, (Attr::readonly | Attr::hidden), "Whether shear acts at the contact point, as in the paper"))
		((std::int8_t, faceForceCode, 0, (Attr::readonly | Attr::hidden), "What the normal force depends on where the bodies tilt, as a "
		        "number (FaceForce)"))
		((bool, internalKnown, false, (Attr::readonly | Attr::hidden), "Whether internal faces have been searched for"))
		((std::int8_t, stiffnessRule, 0, (Attr::readonly | Attr::hidden), "Rule of the contact's physics: none that the geometry knows, a "
		        "stiffness per area or one per contact (StiffnessRule)"))
		((Real, sizeAtSearch, 0, (Attr::readonly | Attr::hidden), "Radius of the overlap's ball times contactArea when they were last "
		        "searched for [m³]"))
		((Real, share, 1, Attr::readonly, "Part of the stiffness that this contact has [-]: less than 1 where the body is on several "
		        "pieces, by the areas on each. Polytopes: per contact and with YADE's own physics, on pieces of a rigid support that lie "
		        "flush (fixed bodies, members of a clump). Shapes with a margin of extensions: on pieces of a rigid support, by what of "
		        "the body's section lies in each. Spheres: on polytopes that meet under it, fixed or free, with every rule; "
		        ":yref:`contactArea<PolytopeGeom.contactArea>` is this part, too. The stiffnesses of YADE's own physics contain it."))
		((Real, normalWeight, 0.5, Attr::readonly, "*boon2012*: weight of body 1's normal against body 2's (1 minus it), from the bodies' "
		        "stiffnesses: the normal is closer to that of the stiffer body."))
		((Real, energyPerStiffness, -1, Attr::readonly, "Elastic energy of the normal force over $k_n$ at this depth [m²], *foundation*: "
		        "while O.trackEnergy is on or :yref:`computeEnergy<Ig2_Polytope_Polytope_PolytopeGeom.computeEnergy>` asks for it; -1 where "
		        "it is not known, and with *boon2012*, where it is half the square of the depth."))
		((Real, turningArm, 0, Attr::readonly, "Contacts *foundation* and *spring*: moment about the normal that a force at the contact "
		        "point leaves out, over that force [m]; positive: it turns body 2 about the normal."))
		((Vector3r, direction, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Last dual direction of the linear program if the points "
		        "are known, otherwise the weights of the basis' first planes"))
		((Vector3r, point1, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Last contact point in body 1's frame, the next step's "
		        "warm-start point"))
		((Vector3r, point2, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Last contact point in body 2's frame"))
		((BasisCodes, basis, , (Attr::readonly | Attr::hidden), "The linear program's last basis, 2 × plane + body"))
		((PlaneCodes, internalFaces, , (Attr::readonly | Attr::hidden), "Planes that are internal faces of a rigid support, 2 × plane + "
		        "body"))
		((PlaneEnds, internalEnds, , (Attr::readonly | Attr::hidden), "Planes that other pieces of a support have near (src/contact/ContactTypes.hpp)"))
		((Linear, linear, , (Attr::readonly | Attr::hidden), "The contact near the pose in which it was last computed in full"))
		((StoredOutline, outline, , (Attr::readonly | Attr::hidden), "Outline of the contact area, for rock joints between polyhedra"))
		((Closure, closure, , (Attr::readonly | Attr::hidden), "Normal law of its rock joint; none: a linear spring"))
		((Widening, widened, , (Attr::readonly | Attr::hidden), "How far the dilation of its rock joint holds the bodies apart"))
		((StoredVertices, surface, , (Attr::readonly | Attr::hidden), "Vertices of the last feasible set of the models that have a surface, "
		        "by their planes"))
		, /*ctor*/ createIndex(); normal = contactPoint = Vector3r::Zero(); // YADE leaves them as they are; a pair apart is saved, too
		, /*py*/
		.add_property("outline", &PolytopeGeom::outlineCorners, "Corners of the contact area as seen along the normal, a list of points [m] "
		        "in the plane through the contact point: the face over which a rock joint between polyhedra shears. Empty for others, and "
		        "mostly until the next step after loading a scene.")
		.add_property("status", &PolytopeGeom::statusText, R"""(How the last query ended: *contact*; *separated*; *normalFromOneBody*
(*boon2012*: the point lies deeper than the corner radius in one body, the other's normal is used); *normalFromDual* (in both: the linear program's
separating direction is used); *roundingLimited* (overlap as thin as rounding); *centreByIpopt* (Newton did not converge to the point, Ipopt found
it); *centreNotConverged* (neither Newton nor Ipopt converged), *ipoptNotAvailable* (the build has none), *lpNotConverged* (in these three the linear
program's point is used); *noDirection* (coincident bodies, and bodies that pierce each other); *failed* (last step's geometry is kept);
*surfaceIncomplete* (*foundation*, *spring*: a part of the surface was not found).)""")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(PolytopeGeom, ScGeom);
};
REGISTER_SERIALIZABLE(PolytopeGeom);

} // namespace yade

POLYTOPE_SAVED_FLAT_WITH_ITS_OWNER(PolytopeGeom)
