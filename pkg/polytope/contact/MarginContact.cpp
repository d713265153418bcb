// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MarginContact.hpp"

#include "contact/StiffnessShare.hpp"
#include "shape/ShapeFamily.hpp"

#include <core/Scene.hpp>

#include <src/contact/PairDistance.hpp>
#include <src/contact/SpreadContact.hpp>
#include <src/numbers/Tolerances.hpp>
#include <src/shape/ClosestPoint.hpp>
#include <src/shear/ContactOutline.hpp>

#include <optional>

namespace yade {

POLYTOPE_CLASSES((PolytopeMarginFunctor));

namespace {

	using polytope::CoreInPlace;

	/// The shortest way between two cores: from a place of body 1's, which is relative to its origin.
	struct Way {
		Vector3r normal, foot;
		Real     deepest; ///< overlap of the bodies there; below 0: apart by as much [m]
	};

	/// Of a segment or point with half-spaces. \param sign +1: the segment is body 1
	Way fromSegment(const CoreOfBody& segment, const CoreOfBody& other, int sign)
	{
		const Matrix3r turn  = other.rotation.transpose();
		const auto     found = polytope::closestOnSegment(
                        *other.convex, Vector3r(turn * (segment.origin - other.origin)), Vector3r(turn * segment.way));
		const Vector3r outward = other.rotation * found.nearest.outward, foot = other.rotation * found.nearest.point;
		const Real     depth = segment.margin + other.margin - found.nearest.distance;
		if (sign > 0) return { -outward, found.along * segment.way, depth };
		return { outward, foot, depth };
	}

	/// Of two segments or points; none where they cross.
	std::optional<Way> betweenSegments(const CoreOfBody& one, const CoreOfBody& other)
	{
		const auto     along = polytope::closestOnSegments(one.origin, one.way, other.origin, other.way);
		const Vector3r way   = other.origin + along[1] * other.way - one.origin - along[0] * one.way;
		const Real     gap   = way.norm();
		if (!(gap > 0)) return std::nullopt;
		return Way { way / gap, along[0] * one.way, one.margin + other.margin - gap };
	}

	/// Of half-spaces with half-spaces that are apart.
	std::optional<Way> betweenHalfSpaces(const CoreOfBody& one, const CoreOfBody& other, const Vector3r& moved)
	{
		const auto gap = polytope::pairDistance(
		        { *one.convex, one.rotation, *other.convex, other.rotation, Vector3r(other.origin + moved - one.origin) });
		if (!(gap.distance > 0)) return std::nullopt;
		return Way { gap.normal, gap.point[0], one.margin + other.margin + moved.dot(gap.normal) - gap.distance };
	}

	/// No polygon: that is no solid here.
	bool isSolid(const CoreOfBody& core) { return core.margin >= 0 && (!core.convex || core.convex->dimension() == 3); }

	/// Place and motion of a segment that others carry, where it is touched.
	void moveWithEnds(const CoreOfBody& core, const Real& along, State& foot)
	{
		const State &start = *core.end1, &end = *core.end2;
		foot.pos    = start.pos + along * (end.pos - start.pos);
		foot.vel    = start.vel + along * (end.vel - start.vel);
		foot.angVel = start.angVel + along * (end.angVel - start.angVel);
	}

	/// Place on a segment of what acts at a point, 0 to 1.
	Real placeOn(const CoreOfBody& segment, const Vector3r& point)
	{
		const Real square = segment.way.squaredNorm();
		if (!(square > 0)) return 0;
		return math::min(math::max(Real((point - segment.origin).dot(segment.way) / square), Real(0)), Real(1));
	}

	void publish(Real depth, Real energy, Vector3r normal, Vector3r point, polytope::ContactResult& result)
	{
		result               = {};
		result.depth         = depth;
		result.normal        = normal;
		result.point         = point;
		result.inContact     = depth > 0;
		result.hasGeometry   = true;
		result.status        = result.inContact ? polytope::ContactStatus::Contact : polytope::ContactStatus::Separated;
		result.infeasibility = -depth / 2; // the largest ball between two surfaces has the depth as its diameter
		result.energy        = result.inContact ? energy : Real(0);
	}

	/// The contact of half-spaces that overlap: without margins it is the answer, `result`; with margins the way from where body 2 is moved out of it.
	std::optional<Way> outOfOverlap(
	        const CoreOfBody& one, const CoreOfBody& other, polytope::ContactSettings settings, polytope::ContactResult& result)
	{
		static thread_local polytope::ContactWorkspace workspace;
		settings.geometryAcrossGap = settings.section = settings.outline = true;
		polytope::PairMemory memory;
		contactQuery({ *one.convex, one.rotation, *other.convex, other.rotation, other.origin - one.origin }, settings, memory,
		        workspace, result);
		if (!result.inContact) result.depth = 0; // they just touch
		const Real margins = one.margin + other.margin;
		if (!(margins > 0)) return std::nullopt;
		const Real size = math::min(one.convex->boundingRadius(), other.convex->boundingRadius());
		const auto way
		        = betweenHalfSpaces(one, other, Vector3r((2 * result.depth + polytope::tolerance::gapSkin * size) * result.normal));
		const Real depth = result.depth + margins;
		if (!way) publish(depth, depth * depth / 2, result.normal, result.point, result);
		return way;
	}

	/// None where there is no answer, or `result` is it.
	std::optional<Way> shortestWay(
	        const CoreOfBody& one, const CoreOfBody& other, const polytope::ContactSettings& settings, polytope::ContactResult& result)
	{
		if (!one.convex && !other.convex) return betweenSegments(one, other);
		if (!one.convex) return fromSegment(one, other, +1);
		if (!other.convex) return fromSegment(other, one, -1);
		const auto way = betweenHalfSpaces(one, other, Vector3r::Zero());
		return way ? way : outOfOverlap(one, other, settings, result);
	}

	/// How bodies press on each other along their shortest way. `spread` has the outline of the result.
	void press(const CoreOfBody& one, const CoreOfBody& other, const Way& way, const ClosureOfJoint* joint,
	        polytope::SpreadContact& spread, polytope::ContactResult& result)
	{
		const Vector3r toMiddle = (one.margin - way.deepest / 2) * way.normal;
		if (!(way.deepest > 0)) return publish(way.deepest, 0, way.normal, way.foot + toMiddle, result);
		const auto inPlace = [&](const CoreOfBody& core) {
			return CoreInPlace { core.convex.get(), core.origin - one.origin, core.rotation, core.way };
		};
		spread = polytope::spreadContact(inPlace(one), inPlace(other), way.normal, way.foot, way.deepest);
		// the force that a law has at this depth is that of the mean closure, times its slope
		Real depth = spread.closure * spread.slope, energy = spread.closure * spread.closure / 2;
		if (joint) {
			depth  = joint->law.closure(joint->law.pressure(spread.closure) * spread.slope);
			energy = joint->law.energy(spread.closure) / joint->law.tangent(depth);
		}
		publish(depth, energy, way.normal, spread.point + toMiddle, result);
		result.outline      = spread.outline.data();
		result.outlineCount = int(spread.outline.size());
		result.area         = polytope::momentsOf(result.outline, result.outlineCount).area;
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

	polytope::ContactResult  result;
	const std::optional<Way> way = shortestWay(*one, *other, settings(StiffnessRule::PerContact), result);
	if (!way && !result.hasGeometry) return failed(c);
	polytope::SpreadContact spread;
	if (way) {
		const auto* const known = static_cast<const PolytopeGeom*>(c->geom.get());
		press(*one, *other, *way, known ? known->closure.get() : nullptr, spread, result);
	}
	if (!math::isfinite(result.depth + result.point.sum())) return failed(c);

	State        foot1, foot2;
	const State &moving1 = one->end1 ? foot1 : state1, &moving2 = other->end1 ? foot2 : state2;
	if (one->end1) moveWithEnds(*one, placeOn(*one, one->origin + result.point), foot1);
	if (other->end1) moveWithEnds(*other, placeOn(*other, one->origin + result.point), foot2);
	if (!apply(result, one->origin, moving1, moving2, shift2, force, c)) return false;
	if (!way) return true;
	auto& geom              = static_cast<PolytopeGeom&>(*c->geom);
	geom.faceForceCode      = std::int8_t(polytope::FaceForce::Spring); // with every contact model
	geom.energyPerStiffness = result.energy;
	return true;
}

} // namespace yade
