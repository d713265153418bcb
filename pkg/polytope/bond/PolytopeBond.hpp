// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bond/AttachedBody.hpp"

#include <src/bond/BondSprings.hpp>
#include <src/bond/CommonFace.hpp>

namespace yade {

/// One bond between two bodies: reference area and frames, stiffnesses, strengths, present state. Attributes left at -1 in a pattern for
/// PolytopeBonds::make() are taken from the bodies' materials.
class PolytopeBond : public Serializable {
public:
	virtual ~PolytopeBond() = default;

	Vector3r linearStiffness() const { return area * Vector3r(normalStiffness, shearStiffness, shearStiffness); }
	Vector3r angularStiffness() const
	{
		return Vector3r(twistingStiffness * (secondMoments[0] + secondMoments[1]), bendingStiffness * secondMoments[1],
		        bendingStiffness * secondMoments[0]);
	}
	/// Moment per rotation of its bodies against each other [N m/rad], world axes. `axes`: the bond's.
	Matrix3r rotationStiffness(const Matrix3r& axes) const { return axes * angularStiffness().asDiagonal() * axes.transpose(); }
	/// Joins these bodies over the face that they have in common: its area, moments and corners.
	void join(Body::id_t first, Body::id_t second, const polytope::CommonFace& face);
	/// Sets point and axes on the side of body `which`, 1 or 2: they are these in the world, where the body is now, moved by `shift`.
	void attach(int which, const State& state, const Vector3r& shift, const Vector3r& point, const Quaternionr& axes);
	/// Sets force, moment, energy, their arms and the stresses from where the bodies are, body 2 in the period of body 1 by `shift`.
	polytope::BondMotion follow(const State& state1, const State& state2, const Vector3r& shift);
	/// From now on its fibres bear no more than the tensile strength each (src/bond/TensionFibres.hpp).
	void beginToYield();
	bool yields() const { return !lastingOpenings.empty(); }
	/// Mean of the lasting openings over the area [m].
	Real meanLastingOpening() const;
	/// Taken by fibres that yielded in the last follow() [J].
	Real plasticWork() const { return plasticWork_; }
	/// Strength that these stresses exceed: "tension", "shear", or none.
	const char* exceeded() const;
	/// Whether its two bodies are those between which it was made, not others that have got their numbers. A bond from a file
	/// has those of its numbers.
	bool hasItsBodies(const BodyContainer& bodies) const;
	/// Whether it has been with its bodies since it was made or loaded.
	bool knowsItsBodies() const { return body1_.isKnown() && body2_.isKnown(); }
	/// Makes those of its numbers its own, where it has none yet, or anew.
	void adoptBodies(const BodyContainer& bodies, bool anew = false);
	/// One of its bodies is gone.
	void erase()
	{
		failure = "erased";
		force = moment = Vector3r::Zero();
		energy         = 0;
	}
	bool isFinite() const { return math::isfinite(force.squaredNorm() + moment.squaredNorm()); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PolytopeBond, Serializable,
	R"""(One bond between two :yref:`Polytopes<Polytope>`, made by *polytope.bond(…)* and kept by :yref:`PolytopeBonds` (docs/bonds.md). Its area
and frames are those in which it was made and do not follow the bodies' overlap. Axis 0 of its frame is its normal, from body 1 to body 2, axes 1 and
2 are the principal axes of its area. Stiffnesses and strengths may be changed in a run and take effect in the next step.)""",
		((Body::id_t, id1, Body::ID_NONE, Attr::readonly, "First body."))
		((Body::id_t, id2, Body::ID_NONE, Attr::readonly, "Second body."))
		((Vector3i, cellDist, Vector3i::Zero(), Attr::readonly, "Periodic scenes: by how many cells body 2 is shifted, as "
		        ":yref:`Interaction.cellDist`."))
		((Vector3r, point1, Vector3r::Zero(), Attr::readonly, "Centroid of the area in body 1's axes, from its centre [m]."))
		((Vector3r, point2, Vector3r::Zero(), Attr::readonly, "The same point in body 2's axes, from its centre [m]."))
		((Quaternionr, frame1, Quaternionr::Identity(), Attr::readonly, "The bond's frame in body 1's axes."))
		((Quaternionr, frame2, Quaternionr::Identity(), Attr::readonly, "The bond's frame in body 2's axes."))
		((Real, area, 0, Attr::readonly, "Area $A$ [m²]."))
		((Vector2r, secondMoments, Vector2r::Zero(), Attr::readonly, "$\\int y^2dA$ and $\\int z^2dA$ along axes 1 and 2, from the centroid "
		        "[m⁴]."))
		((vector<Vector3r>, corners, , Attr::readonly, "Corners $(0, y, z)$ of the area in the bond's frame [m]."))
		((Real, overlap, 0, Attr::readonly, "Overlap of the faces when the bond was made [m], 0 across a gap: what the joint that follows "
		        "the bond has no force at."))
		((Real, normalStiffness, -1, , "Normal stiffness per area $k_n$ [Pa/m]."))
		((Real, shearStiffness, -1, , "Shear stiffness per area $k_s$ [Pa/m]."))
		((Real, bendingStiffness, -1, , "Normal stiffness per area in bending $k_b$ [Pa/m]: the moment per rotation is $k_b\\int z^2dA$."))
		((Real, twistingStiffness, -1, , "Shear stiffness per area in twisting $k_t$ [Pa/m]: the moment per rotation is "
		        "$k_t\\int(y^2+z^2)dA$."))
		((Real, tensileStrength, -1, , "Tensile strength $\\sigma_t$ [Pa]; infinite: none."))
		((Real, cohesion, -1, , "Cohesion $c$ [Pa]; infinite: no failure in shear."))
		((Real, frictionAngle, -1, , "Friction angle $\\phi$ of the strength [rad]."))
		((Real, bendingShare, 1, , "Part $\\beta$ of the stresses by bending and twisting that counts against the strengths [-]: 1: the "
		        "beam formula's stress at the edge; 0: mean stresses alone."))
		((bool, intact, true, Attr::readonly, "Whether the bond acts."))
		((string, failure, "", Attr::readonly, "How it ended: *tension*, *shear*, *erased* (with a body); empty while it is intact."))
		((long, failedAt, -1, Attr::readonly, "Last step in which it acted; -1: intact."))
		((Vector3r, force, Vector3r::Zero(), Attr::readonly, "Present force on body 2 [N]; the opposite one acts on body 1, at the same "
		        "point."))
		((Vector3r, moment, Vector3r::Zero(), Attr::readonly, "Present moment on body 2 [N·m]; the opposite one acts on body 1."))
		((Vector3r, point, Vector3r::Zero(), Attr::readonly, "Where the force acts, in the period of body 1 [m]."))
		((Real, energy, 0, Attr::readonly, "Elastic energy [J]."))
		((Real, normalStress, 0, Attr::readonly, "Mean normal stress $\\sigma$ [Pa], tension positive."))
		((Real, edgeStress, 0, Attr::readonly, "Largest normal stress over the area with the share of bending [Pa], tension positive: fails "
		        "at $\\sigma_t$."))
		((Real, shearStress, 0, Attr::readonly, "Mean shear stress plus the share of the largest one of twisting [Pa]: fails at "
		        "$c-\\sigma\\tan\\phi$."))
		((vector<Real>, lastingOpenings, , (Attr::readonly | Attr::hidden), "Openings of the fibres of a joint that yields in tension [m]; none: it "
		        "does not"))
		((Vector3r, arm1, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "From body 1's centre to the point in the last step"))
		((Vector3r, arm2, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "From body 2's centre to the point in the last step"))
	);
	// clang-format on

private:
	polytope::BondForce yieldingForce(const polytope::BondMotion& motion);
	void                setStresses(const Vector3r& displacement, const Vector3r& rotation);

	AttachedBody body1_, body2_;
	Real         plasticWork_ = 0;
};
REGISTER_SERIALIZABLE(PolytopeBond);

} // namespace yade
