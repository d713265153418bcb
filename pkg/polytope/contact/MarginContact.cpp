// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MarginContact.hpp"

#include "contact/StiffnessShare.hpp"
#include "shape/ShapeFamily.hpp"

#include <core/Scene.hpp>

#include <src/contact/PairDistance.hpp>
#include <src/numbers/Tolerances.hpp>
#include <src/shape/ClosestPoint.hpp>

namespace yade {

YADE_PLUGIN((PolytopeMarginFunctor));

namespace {

	/// Normal, depth and point of a result, from body 1's origin; a depth below zero: apart by as much. `foot`: the end of the shortest way on body 1's half-spaces.
	void setWay(polytope::ContactResult& result, const Vector3r& normal, const Real& depth, const Vector3r& foot, const Real& margin1)
	{
		result.normal = normal;
		result.depth  = depth;
		result.point  = foot + (margin1 - depth / 2) * normal;
	}

	/// Of a ball with half-spaces. \param sign +1: the ball is body 1
	void meetBall(const CoreOfBody& ball, const CoreOfBody& other, int sign, polytope::ContactResult& result)
	{
		const Vector3r way     = ball.origin - other.origin;
		const auto     nearest = polytope::closestPoint(*other.convex, Vector3r(other.rotation.transpose() * way));
		const Vector3r outward = other.rotation * nearest.outward, foot = other.rotation * nearest.point;
		const Real     depth = ball.margin + other.margin - nearest.distance;
		if (sign > 0) setWay(result, -outward, depth, Vector3r::Zero(), ball.margin);
		else setWay(result, outward, depth, foot, other.margin);
	}

	/// Of half-spaces with half-spaces. Returns false where there is no answer.
	bool meet(
	        const CoreOfBody& one, const CoreOfBody& other, const polytope::ContactSettings& settings, polytope::ContactResult& result)
	{
		static thread_local polytope::ContactWorkspace workspace;
		const Vector3r                                 centre2 = other.origin - one.origin;
		const Real                                     margins = one.margin + other.margin;
		const auto gap = polytope::pairDistance(*one.convex, one.rotation, *other.convex, other.rotation, centre2);
		if (gap.distance >= margins) {
			setWay(result, gap.normal, margins - gap.distance, gap.point[0], one.margin);
			return true;
		}
		// the half-spaces' contact; apart, moved together until they touch: its point is where the surfaces face each other
		const Real           size = math::min(one.convex->boundingRadius(), other.convex->boundingRadius());
		const Real           way  = gap.distance > 0 ? gap.distance + Real(polytope::tolerance::gapSkin) * size : Real(0);
		polytope::PairMemory memory;
		contactQuery(*one.convex, one.rotation, *other.convex, other.rotation, centre2 - way * gap.normal, settings, memory,
		        workspace, result);
		if (!result.inContact) return false;
		if (gap.distance > 0) {
			const Vector3r foot = result.point + (gap.point[0] - result.point).dot(gap.normal) * gap.normal;
			setWay(result, gap.normal, margins - gap.distance, foot, one.margin);
		} else result.depth += margins;
		return true;
	}

} // namespace

bool PolytopeMarginFunctor::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const Vector3r place2 = state2.pos + shift2;
	const auto     one    = familyOf(*shape1).core(*shape1, state1.pos, state1.ori, place2);
	const auto     other  = familyOf(*shape2).core(*shape2, place2, state2.ori, state1.pos);
	if (!one || !other || (!one->convex && !other->convex)) return failed(c);
	if (!c->isReal() && stiffnessRuleOfNew(*scene, *c) == StiffnessRule::PerArea) return failed(c);
	polytope::ContactResult result;
	if (!one->convex) meetBall(*one, *other, +1, result);
	else if (!other->convex) meetBall(*other, *one, -1, result);
	else if (!meet(*one, *other, settings(StiffnessRule::PerContact), result)) return failed(c);
	result.inContact     = result.depth > 0;
	result.hasGeometry   = true;
	result.status        = result.inContact ? polytope::ContactStatus::Contact : polytope::ContactStatus::Separated;
	result.infeasibility = -result.depth / 2; // the largest ball between two surfaces has the depth as its diameter
	result.energy        = result.inContact ? result.depth * result.depth / 2 : Real(0);
	return apply(result, one->origin, state1, state2, shift2, force, c);
}

bool PolytopeMarginFunctor::goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	c->swapOrder();
	return go(shape2, shape1, state2, state1, -shift2, force, c);
}

} // namespace yade
