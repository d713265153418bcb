// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/RockJointDampers.hpp"

#include <core/Clump.hpp>
#include <lib/high-precision/Constants.hpp>

#include "host/PartsOfBodies.hpp"
#include "joint/RockJointStep.hpp"
#include "shape/ShapeFamily.hpp"

namespace yade {

namespace {

	/// Number of parts of a clump; 1 for a body alone.
	std::size_t countOfParts(const Body& mover) { return mover.isClump() ? static_cast<const Clump&>(*mover.shape).members.size() : 1; }

	/// s of a contact that was in no sum.
	Real partOfArea(const Body& body, const Body& mover, const Vector3r& normal, Real area)
	{
		const Real shown = familyOf(*body.shape).projectedArea(*body.shape, body.state->ori.conjugate() * normal)
		        * Real(countOfParts(mover));
		return shown > area ? area / shown : Real(1);
	}

	/// s of a contact that was in no sum, with a stiffness per contact: as if the body came down at once on all that it may touch.
	Real partOfCount(const Body& body, const Body& mover, Real share)
	{
		return math::min(share, 1 / Real(math::max(std::size_t(1), countOfParts(mover) * body.intrs.size())));
	}

	/// s of a contact that had this stiffness when the sum, along its normal, was made.
	Real partOfSum(Real stiffness, Real sum) { return sum > stiffness ? stiffness / sum : Real(1); }

	/// Whether it has a mass that a damper can slow down.
	bool hasDampedMass(const Body& mover) { return isMovedByForces(mover) && mover.state->mass > 0; }

	/// What a body of a contact is for the other one.
	Across across(const Body& body, const Scene& scene)
	{
		return hasDampedMass(moverOf(body, scene)) ? Across::Mover : Across::Support;
	}

	/// uᵀ I⁻¹ u; mobilityOf() of the time step has the root of I⁻¹, which would take six roots here.
	Real turning(const Body& mover, const Vector3r& u)
	{
		const State&    state   = *mover.state;
		const Vector3r& inertia = state.inertia;
		const Vector3r  v       = turnsAboutOwnAxes(mover) ? Vector3r(state.ori.conjugate() * u) : u;
		Real            sum     = 0;
		for (int k = 0; k < 3; ++k)
			if (inertia[k] > 0 && !(state.blockedDOFs & State::axisDOF(k, true))) sum += v[k] * v[k] / inertia[k];
		return sum;
	}

	/// 1 over this is not below turning() of any direction of length 1.
	Real leastInertia(const Body& mover)
	{
		const Vector3r& inertia = mover.state->inertia;
		Real            least   = std::numeric_limits<Real>::infinity();
		for (int k = 0; k < 3; ++k)
			if (inertia[k] > 0 && inertia[k] < least) least = inertia[k];
		return least;
	}

	/// uᵀ M⁻¹ u.
	Real translating(const Body& mover, const Vector3r& u)
	{
		Real sum = 0;
		for (int k = 0; k < 3; ++k)
			if (!(mover.state->blockedDOFs & State::axisDOF(k, false))) sum += u[k] * u[k];
		return sum / mover.state->mass;
	}

} // namespace

Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::DampedBody::DampedBody(
        const Pair& pair, const RockJointPhys& phys, const StiffnessSums& sums, const Body& body, const Body& other, const Vector3r& shift)
        : mover(moverOf(body, *pair.scene)), moves(hasDampedMass(mover)), otherIs(across(other, *pair.scene)),
          arm(pair.geom.contactPoint - mover.state->pos - shift)
{
	if (!moves) return;
	const Vector3r& normal = pair.geom.normal;
	if (phys.dampedStiffness > 0 && sums.lastKnown()) {
		const StiffnessSum& sum   = sums.last(mover.id);
		const Real          alike = sum.along(otherIs, normal), others = sum.along(otherThan(otherIs), normal);
		part  = partOfSum(phys.dampedStiffness, alike);
		limit = others > 0 ? math::max(Real(part / 2), partOfSum(phys.dampedStiffness, alike + others)) : part;
	} else if (pair.geom.stiffnessRule == int(StiffnessRule::PerContact)) {
		part  = pair.geom.share;
		limit = partOfCount(body, mover, pair.geom.share);
	} else part = limit = partOfArea(body, mover, normal, phys.contactArea);
	const Real turning = 1 / (leastInertia(mover) * limit);
	mostMotion         = { { 1 / (mover.state->mass * limit) + arm.squaredNorm() * turning, turning } };
}

Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::DampedPair::DampedPair(const Pair& pair, const RockJointPhys& phys, const StiffnessSums& sums)
        : body { { pair, phys, sums, *pair.body1, *pair.body2, Vector3r(Vector3r::Zero()) },
	          { pair, phys, sums, *pair.body2, *pair.body1, pair.shift2() } },
          dt(pair.scene->dt)
{
	for (const DampedBody& one : body)
		if (one.moves) inverse += 1 / (one.part * one.mover.state->mass);
}

Real Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::DampedPair::damper(
        Real fraction, Real stiffness, const Vector3r& direction, Real gyrationSquared) const
{
	if (!(inverse > 0)) return 0;
	const bool rocks  = gyrationSquared >= 0;
	const Real damper = fraction * criticalDamper(stiffness, inverse) * (rocks ? gyrationSquared : Real(1));
	if (damper * dt * (body[0].mostMotion[rocks] + body[1].mostMotion[rocks]) <= 1) return damper;
	Real motion = 0;
	for (const DampedBody& one : body)
		if (one.moves)
			motion += (rocks ? turning(one.mover, direction)
			                 : translating(one.mover, direction) + turning(one.mover, one.arm.cross(direction)))
			        / one.limit;
	return damper * motion * dt > 1 ? 1 / (motion * dt) : damper;
}

/// The contact was part of what carries its bodies in this step.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::takePart(const Pair& pair, const DampedPair& damped, RockJointPhys& phys)
{
	phys.dampedStiffness = math::isfinite(phys.kn) ? phys.kn : Real(0);
	for (const DampedBody& one : damped.body)
		if (one.moves) stiffnessSums.add(one.mover.id, one.otherIs, phys.dampedStiffness, pair.geom.normal);
}

/// Viscous normal force on body 2, along the normal: against the closing of its spring, which dilation that grows by `rising` in this step takes part in.
/// Is not tensile in a joint without tensile strength.
Real Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::normalDamper(
        const Pair& pair, const DampedPair& damped, const RockJointPhys& phys, Real elastic, Real rising) const
{
	const Vector3r& normal       = pair.geom.normal;
	const Real      opening      = normal.dot(pair.velocity()) - rising / damped.dt;
	const Real      viscous      = -damped.damper(normalDamping, phys.kn, normal) * opening;
	const bool      takesTension = phys.presentTensileStrength() > 0;
	return takesTension ? viscous : math::max(viscous, -elastic);
}

/// Viscous shear force on body 2, at most to the strength.
Vector3r Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::shearDamper(
        const Pair& pair, const DampedPair& damped, const RockJointPhys& phys, Real normal, const Vector3r& shear) const
{
	const Vector3r velocity = pair.velocity(), along = velocity - pair.geom.normal.dot(velocity) * pair.geom.normal;
	const Real     speed = along.norm();
	if (!(speed > 0)) return Vector3r::Zero();
	const Vector3r viscous = -damped.damper(shearDamping, phys.ks, along / speed) * along;
	return fractionWithin(phys.shearStrength(normal), shear, viscous) * viscous;
}

/// Moment on body 2 of dampers spread over the contact area, as far as a pressure that gives this normal force can balance it.
Vector3r Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::rockingDamper(
        const Pair& pair, const DampedPair& damped, const RockJointPhys& phys, Real normal) const
{
	const Real     gyrationSquared = rockingGyrationSquared(*pair.body1, *pair.body2, phys);
	const Vector3r rocking         = pair.spin() - pair.geom.normal.dot(pair.spin()) * pair.geom.normal;
	const Real     rate            = rocking.norm();
	if (!(rate > 0)) return Vector3r::Zero();
	const Vector3r moment = -damped.damper(rockingDamping, phys.kn, rocking / rate, gyrationSquared) * rocking;
	const Real     limit = math::sqrt(3 * gyrationSquared) * normal, size = moment.norm();
	return size > limit ? Vector3r(limit / size * moment) : moment;
}

Real rockingGyrationSquared(const Body& body1, const Body& body2, const RockJointPhys& phys)
{
	const auto *polygon = dynamic_cast<const Polytope*>(body1.shape.get()), *other = dynamic_cast<const Polytope*>(body2.shape.get());
	if (!polygon || !other || polygon->dimension != 2) return phys.contactArea / 12;
	return math::pow(phys.contactArea / math::min(polygon->thickness, other->thickness), 2) / 12;
}

Real inverseDampedMass(const Body& body1, const Body& body2, const Vector3r& normal, const RockJointPhys& phys, const StiffnessSums& sums,
        const Scene& scene)
{
	Real inverse = 0;
	for (const Body* body : { &body1, &body2 }) {
		const Body& mover = moverOf(*body, scene);
		if (!hasDampedMass(mover)) continue;
		// of a contact that is in no sum, as after a law was exchanged, the largest that it can be
		const Real part = phys.dampedStiffness > 0
		        ? partOfSum(
		                  phys.dampedStiffness, sums.newest(mover.id).along(across(body == &body1 ? body2 : body1, scene), normal))
		        : Real(1);
		inverse += 1 / (part * mover.state->mass);
	}
	return inverse;
}

} // namespace yade
