// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MarginContact.hpp"

#include "contact/StiffnessShare.hpp"
#include "shape/ShapeFamily.hpp"

#include <core/Scene.hpp>

#include <src/contact/PairDistance.hpp>
#include <src/numbers/Tolerances.hpp>
#include <src/shape/ClosestPoint.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeMarginFunctor));

namespace {

	/// Normal, depth and point of a result, from body 1's origin; a depth below zero: apart by as much. `foot`: the end of the shortest way on body 1's half-spaces.
	void setWay(polytope::ContactResult& result, const Vector3r& normal, const Real& depth, const Vector3r& foot, const Real& margin1)
	{
		result.normal = normal;
		result.depth  = depth;
		result.point  = foot + (margin1 - depth / 2) * normal;
	}

	/// Of a segment or point with half-spaces. \param sign +1: the segment is body 1. Returns its place along the segment.
	Real meetSegment(const CoreOfBody& segment, const CoreOfBody& other, int sign, polytope::ContactResult& result)
	{
		const Matrix3r turn  = other.rotation.transpose();
		const auto     found = polytope::closestOnSegment(
                        *other.convex, Vector3r(turn * (segment.origin - other.origin)), Vector3r(turn * segment.way));
		const Vector3r outward = other.rotation * found.nearest.outward, foot = other.rotation * found.nearest.point;
		const Real     depth = segment.margin + other.margin - found.nearest.distance;
		if (sign > 0) setWay(result, -outward, depth, found.along * segment.way, segment.margin);
		else setWay(result, outward, depth, foot, other.margin);
		return found.along;
	}

	/// Of two segments or points. Returns their places, negative where they cross: there is no answer.
	polytope::Vector2 meetSegments(const CoreOfBody& one, const CoreOfBody& other, polytope::ContactResult& result)
	{
		const auto     along = polytope::closestOnSegments(one.origin, one.way, other.origin, other.way);
		const Vector3r way   = other.origin + along[1] * other.way - one.origin - along[0] * one.way;
		const Real     gap   = way.norm();
		if (!(gap > 0)) return polytope::Vector2::Constant(-1);
		setWay(result, way / gap, one.margin + other.margin - gap, along[0] * one.way, one.margin);
		return along;
	}

	/// No polygon: that is no solid here.
	bool isSolid(const CoreOfBody& core) { return !core.convex || core.convex->dimension() == 3; }

	/// Place and motion of a segment that others carry, where it is touched.
	void moveWithEnds(const CoreOfBody& core, const Real& along, State& foot)
	{
		const State &start = *core.end1, &end = *core.end2;
		foot.pos    = start.pos + along * (end.pos - start.pos);
		foot.vel    = start.vel + along * (end.vel - start.vel);
		foot.angVel = start.angVel + along * (end.angVel - start.angVel);
	}

	/// Of half-spaces with half-spaces. Returns false where there is no answer.
	bool meet(
	        const CoreOfBody& one, const CoreOfBody& other, const polytope::ContactSettings& settings, polytope::ContactResult& result)
	{
		static thread_local polytope::ContactWorkspace workspace;
		const Vector3r                                 centre2 = other.origin - one.origin;
		const Real                                     margins = one.margin + other.margin;
		const auto gap = polytope::pairDistance(*one.convex, one.rotation, *other.convex, other.rotation, centre2);
		if (gap.distance > 0 && gap.distance >= margins) {
			setWay(result, gap.normal, margins - gap.distance, gap.point[0], one.margin);
			return true;
		}
		// the half-spaces' contact; apart, moved together until they touch: its point is where the surfaces face each other
		const Real           size = math::min(one.convex->boundingRadius(), other.convex->boundingRadius());
		const Real           way  = gap.distance > 0 ? gap.distance + Real(polytope::tolerance::gapSkin) * size : Real(0);
		polytope::PairMemory memory;
		contactQuery(*one.convex, one.rotation, *other.convex, other.rotation, centre2 - way * gap.normal, settings, memory,
		        workspace, result);
		if (!result.inContact && margins > 0) return false;
		if (!result.inContact) result.depth = 0; // half-spaces without a margin that just touch
		else if (gap.distance > 0) {
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
	if (!one || !other || !isSolid(*one) || !isSolid(*other)) return failed(c);
	if (!c->isReal() && stiffnessRuleOfNew(*scene, *c) == StiffnessRule::PerArea) return failed(c);
	polytope::ContactResult result;
	polytope::Vector2       along = polytope::Vector2::Zero(); // of those that are segments
	if (!one->convex && !other->convex) along = meetSegments(*one, *other, result);
	else if (!one->convex) along[0] = meetSegment(*one, *other, +1, result);
	else if (!other->convex) along[1] = meetSegment(*other, *one, -1, result);
	else if (!meet(*one, *other, settings(StiffnessRule::PerContact), result)) return failed(c);
	if (along[0] < 0 || !math::isfinite(result.depth)) return failed(c);
	result.inContact     = result.depth > 0;
	result.hasGeometry   = true;
	result.status        = result.inContact ? polytope::ContactStatus::Contact : polytope::ContactStatus::Separated;
	result.infeasibility = -result.depth / 2; // the largest ball between two surfaces has the depth as its diameter
	result.energy        = result.inContact ? result.depth * result.depth / 2 : Real(0);
	if (!one->end1 && !other->end1) return apply(result, one->origin, state1, state2, shift2, force, c);
	State foot1, foot2;
	if (one->end1) moveWithEnds(*one, along[0], foot1);
	if (other->end1) moveWithEnds(*other, along[1], foot2);
	return apply(result, one->origin, one->end1 ? foot1 : state1, other->end1 ? foot2 : state2, shift2, force, c);
}

} // namespace yade
