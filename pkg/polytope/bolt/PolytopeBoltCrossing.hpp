// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bond/AttachedBody.hpp"
#include "host/SpringsOfScene.hpp"

namespace yade {

/// Where a bolt goes over from one block that holds it to the next: the pull of the steel between two points, and the dowel's shear.
class PolytopeBoltCrossing : public Serializable {
public:
	virtual ~PolytopeBoltCrossing() = default;

	/// Distance of the two points less the one at which the crossing was made [m].
	Real newOpening(const BodyContainer& bodies) const;
	/// Takes this opening and tension, and the shear that follows from where the bodies are; returns the work done on the crossing since the last step.
	Real follow(const BodyContainer& bodies, const Real& openingNow, const Real& tensionNow, bool unlimited);
	/// Adds force and moment on both bodies.
	void apply(Scene& scene) const;
	/// Elastic energy of the dowel [J].
	Real energy() const { return dowelStiffness > 0 ? dowelForce.squaredNorm() / (2 * dowelStiffness) : Real(0); }
	/// The steel is broken, or a body gone.
	void end(const char* reason);

	bool hasItsBodies(const BodyContainer& bodies) const { return body1_.isStill(id1, bodies) && body2_.isStill(id2, bodies); }
	/// Whether it has been with its bodies since it was made or loaded.
	bool knowsItsBodies() const { return body1_.isKnown() && body2_.isKnown(); }
	void adoptBodies(const BodyContainer& bodies)
	{
		body1_.adopt(id1, bodies);
		body2_.adopt(id2, bodies);
	}
	/// A place of the bolt in the world, as one of the bodies carries it [m].
	Vector3r placeOn(const BodyContainer& bodies, bool second, const Real& place) const;
	/// The springs that one of the bodies feels here.
	SpringsAtPoint springsOn(const Body& body) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PolytopeBoltCrossing, Serializable,
	R"""(Where a :yref:`PolytopeBolt` goes over from one block that holds it to the next (docs/support.md): it pulls the two blocks together along
the line between two points, the ends of what steel is free of grout there, and where it is grouted on both sides of a joint it resists shear as a
dowel.)""",
		((Body::id_t, id1, Body::ID_NONE, Attr::readonly, "Block on the side of the head; for a clump, one of its members."))
		((Body::id_t, id2, Body::ID_NONE, Attr::readonly, "Block on the side of the end."))
		((Real, start, 0, Attr::readonly, "Where the free steel begins, from the bolt's head [m]."))
		((Real, stop, 0, Attr::readonly, "Where the free steel ends, from the bolt's head [m]."))
		((Real, stiffness, 0, Attr::readonly, "Tension per opening while all is elastic: free steel and what grout holds on both sides in "
		        "series [N/m]."))
		((Real, dowelStiffness, 0, Attr::readonly, "Shear force per shear displacement [N/m]."))
		((Real, dowelStrength, 0, Attr::readonly, "Largest shear force [N]."))
		((Real, opening, 0, Attr::readonly, "Growth of the distance of the two points [m]."))
		((Real, tension, 0, Attr::readonly, "Force along the line between the two points [N]; below 0: compression."))
		((Vector3r, shearForce, Vector3r::Zero(), Attr::readonly, "Shear force of the dowel on block 2 [N]; block 1 gets the opposite one."))
		((Vector2r, shear, Vector2r::Zero(), Attr::readonly, "Displacement of block 2 against block 1 across the bolt [m], along axes 1 and "
		        "2 of *frame1*."))
		((Vector2r, plasticShear, Vector2r::Zero(), Attr::readonly, "The plastic part of *shear* [m]."))
		((string, failure, "", Attr::readonly, "Empty while the crossing acts; *rupture*: the steel broke here; *erased*: a block is gone."))
		((Vector3r, point1, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Point of body 1, in its axes"))
		((Vector3r, point2, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Point of body 2, in its axes"))
		((Vector3r, middle1, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Middle between the points when the crossing was made, in "
		        "body 1's axes"))
		((Vector3r, middle2, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "The same point in body 2's axes"))
		((Quaternionr, frame1, Quaternionr::Identity(), (Attr::readonly | Attr::hidden), "Axis 0 along the bolt, in body 1's axes"))
		((Quaternionr, frame2, Quaternionr::Identity(), (Attr::readonly | Attr::hidden), "Axis 0 along the bolt, in body 2's axes"))
		((Vector2r, dowelForce, Vector2r::Zero(), (Attr::readonly | Attr::hidden), "Force of the dowel along axes 1 and 2, against the shear"))
		((int, element, -1, (Attr::readonly | Attr::hidden), "Number of the element of the bolt's steel"))
		((Vector3r, force, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Tension on body 1"))
		((Vector3r, dowelMoment, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Moment of the dowel on body 2"))
		((Vector3r, dowelArm1, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "From body 1's centre to where the dowel acts"))
		((Vector3r, dowelArm2, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "From body 2's centre to where the dowel acts"))
	);
	// clang-format on

private:
	Real followShear(const State& state1, const State& state2, bool unlimited);

	AttachedBody body1_, body2_;
};
REGISTER_SERIALIZABLE(PolytopeBoltCrossing);

} // namespace yade
