// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MarginContact.hpp"

#include "contact/InternalFaces.hpp"
#include "contact/MarginOnPieces.hpp"
#include "contact/StandIns.hpp"
#include "contact/StiffnessShare.hpp"
#include "host/ExactClass.hpp"

#include <core/Scene.hpp>

#include <src/contact/PairDistance.hpp>
#include <src/contact/SpreadContact.hpp>
#include <src/numbers/PlaneAxes.hpp>
#include <src/numbers/Tolerances.hpp>
#include <src/shape/ClosestPoint.hpp>
#include <src/shape/DistanceTolerances.hpp>
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

	/// The way between a segment or point and half-spaces. \param sign +1: the segment is body 1
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

	/// The way between two segments or points; none where they cross.
	std::optional<Way> betweenSegments(const CoreOfBody& one, const CoreOfBody& other)
	{
		const auto     along = polytope::closestOnSegments(one.origin, one.way, other.origin, other.way);
		const Vector3r way   = other.origin + along[1] * other.way - one.origin - along[0] * one.way;
		const Real     gap   = way.norm();
		if (!(gap > 0)) return std::nullopt;
		return Way { way / gap, along[0] * one.way, one.margin + other.margin - gap };
	}

	/// The way between two bodies of half-spaces that are apart; none where they are not.
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

	/// The way between two bodies of half-spaces that overlap. Without margins their contact is the answer, `result`; with margins it is the way from
	/// where body 2 is moved out of body 1 along the normal of that contact, or, where that does not lead out of it, along the normal itself.
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
		if (!(margins > 0) || !result.hasGeometry) return std::nullopt;
		const Real size = math::min(one.convex->boundingRadius(), other.convex->boundingRadius());
		// that depth is a mean over the overlap: at a corner, a third of what leads out of it
		std::optional<Way> way;
		for (Real times = 2; !way && times <= Real(polytope::tolerance::farthestOut); times *= 2)
			way = betweenHalfSpaces(
			        one, other, Vector3r((times * result.depth + polytope::tolerance::gapSkin * size) * result.normal));
		return way ? way : Way { result.normal, result.point + result.depth / 2 * result.normal, result.depth + margins };
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

	/// The pieces of a support that one of the bodies moves on, seen from the other one's core.
	class Support {
	public:
		/// \param one, other of the pair's bodies, body 2 where it is in the period of body 1
		Support(const CoreOfBody& one, const CoreOfBody& other, const TouchingPair& pair, Way& way)
		        : one_(one), other_(other), mover_(moverOfPair(pair))
		{
			const CoreOfBody& core = mover_ == 0 ? one : other;
			if (mover_ < 0 || (core.convex && core.convex->polyhedron().vertices.empty())) return;
			TouchingPair seen = pair;
			seen.point        = core.origin;
			const MarginOnPieces pieces(seen, mover_, core);
			if (pieces.alone()) return;
			SupportPlace place = placeOf(way);
			pieces.toNearest(place);
			way   = wayTo(place);
			share = pieces.share(place);
			faces = pieces.faces(place);
			for (auto& face : faces)
				for (Vector3r& corner : face)
					corner += core.origin - one.origin;
		}

		MarginOnPieces::Share              share { 1, Vector3r::Zero() };
		std::vector<polytope::FaceCorners> faces;

		/// The faces of the body with this number, if it is the support; else null.
		const std::vector<polytope::FaceCorners>* facesOf(int body) const
		{
			return body == 1 - mover_ && !faces.empty() ? &faces : nullptr;
		}

	private:
		const CoreOfBody &one_, &other_;
		int               mover_;

		/// Which body moves on the other one, which may be a piece of a support; −1: none.
		static int moverOfPair(const TouchingPair& pair)
		{
			const Body &first = bodyOf(pair, 0), &second = bodyOf(pair, 1);
			if (!mayHaveInternalFaces(first, second)) return -1;
			const bool piece = isPiece(first);
			const int  mover = 1 - (piece == isPiece(second) ? supportOf(pair) : piece ? 0 : 1);
			return bodyOf(pair, mover).intrs.size() < 2 ? -1 : mover;
		}

		/// From the support's core along the normal to that of the body which moves on it.
		Real     gap(const Real& depth) const { return one_.margin + other_.margin - depth; }
		Vector3r toMover() const { return (mover_ == 0 ? one_ : other_).origin - one_.origin; }

		SupportPlace placeOf(const Way& way) const
		{
			const Vector3r foot = way.foot - toMover();
			if (mover_ == 1) return { way.normal, foot, way.deepest };
			return { -way.normal, foot + gap(way.deepest) * way.normal, way.deepest };
		}

		Way wayTo(const SupportPlace& place) const
		{
			const Vector3r foot = place.point + toMover();
			if (mover_ == 1) return { place.outward, foot, place.depth };
			return { -place.outward, foot + gap(place.depth) * place.outward, place.depth };
		}
	};

	/// The strip in which an edge or a segment between two ends lies on the other body, of two margins together and so deep: half its width is
	/// the rim of the section half as deep.
	std::vector<polytope::Vector2> stripAround(const std::vector<polytope::Vector2>& ends, Real margins, Real deepest)
	{
		const polytope::Vector2 way = ends[1] - ends[0];
		if (!(way.norm() > 0)) return {};
		const polytope::Vector2 half = math::sqrt(margins * deepest) / way.norm() * polytope::left(way);
		return { ends[0] - half, ends[1] - half, ends[1] + half, ends[0] + half };
	}

	/// How bodies press on each other along their shortest way. `spread` has the outline of the result.
	void press(const CoreOfBody& one, const CoreOfBody& other, const Way& way, const Support& support, const ClosureOfJoint* joint,
	        polytope::SpreadContact& spread, polytope::ContactResult& result)
	{
		const Vector3r toMiddle = (one.margin - way.deepest / 2) * way.normal;
		const auto     inPlace  = [&](const CoreOfBody& core, int body) {
                        return CoreInPlace { core.convex.get(), core.origin - one.origin, core.rotation, core.way, support.facesOf(body) };
		};
		spread = polytope::spreadContact(inPlace(one, 0), inPlace(other, 1), way.normal, way.foot, way.deepest);
		// the force that a law has at this depth is that of the mean closure, times its slope
		Real depth = spread.closure * spread.slope, energy = spread.closure * spread.closure / 2;
		if (joint) {
			depth  = joint->law.closure(joint->law.pressure(spread.closure) * spread.slope);
			energy = joint->law.energy(spread.closure) / joint->law.tangent(depth);
		}
		if (spread.outline.size() == 2) spread.outline = stripAround(spread.outline, one.margin + other.margin, way.deepest);
		const Vector3r& aside = support.share.aside;
		publish(depth, energy, way.normal, spread.point + aside + toMiddle, result);
		const polytope::PlaneAxes axes(way.normal);
		for (auto& corner : spread.outline)
			corner -= polytope::Vector2(axes.u.dot(aside), axes.v.dot(aside));
		result.outline      = spread.outline.data();
		result.outlineCount = int(spread.outline.size());
		result.area         = polytope::momentsOf(result.outline, result.outlineCount).area;
	}

} // namespace

bool hasMarginCore(const Shape& shape)
{
	return exactly<Box>(&shape) || exactly<Facet>(&shape)
	        || familyOf(shape).core(shape, Vector3r::Zero(), Quaternionr::Identity(), Vector3r::UnitX());
}

std::optional<CoreOfBody> PolytopeMarginFunctor::standIn(
        const Shape& shape, const shared_ptr<Interaction>& contact, int which, const Vector3r& shift2, const CoreOfBody& partner)
{
	const Body &body    = *Body::byId(which == 0 ? contact->getId1() : contact->getId2(), scene),
	           &met     = *Body::byId(which == 0 ? contact->getId2() : contact->getId1(), scene);
	const Real rounding = partner.convex ? partner.convex->cornerRadius() : Real(0),
	           reach    = (partner.convex ? partner.convex->boundingRadius() : partner.way.norm()) + partner.margin;
	StandIn& standIn    = geometry(contact).standIn.make();
	if (const auto* box = exactly<Box>(&shape)) standForBox(*box, rounding, standIn);
	else if (exactly<Facet>(&shape))
		standForFacet(body, met, which == 0 ? shift2 : Vector3r(-shift2), *scene, !contact->isReal(), 2 * reach, rounding, standIn);
	else return std::nullopt;
	if (!standIn.partner) return std::nullopt;
	const Vector3r place = which == 0 ? body.state->pos : Vector3r(body.state->pos + shift2);
	return CoreOfBody { standIn.partner, 0, place, body.state->ori.toRotationMatrix() };
}

bool PolytopeMarginFunctor::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const Vector3r place2 = state2.pos + shift2;
	auto           one    = familyOf(*shape1).core(*shape1, state1.pos, state1.ori, place2);
	auto           other  = familyOf(*shape2).core(*shape2, place2, state2.ori, state1.pos);
	if (!one && other) one = standIn(*shape1, c, 0, shift2, *other);
	else if (one && !other) other = standIn(*shape2, c, 1, shift2, *one);
	if (!one || !other || !isSolid(*one) || !isSolid(*other)) return failed(c);
	if (!c->isReal() && stiffnessRuleOfNew(*scene, *c) == StiffnessRule::PerArea) return failed(c);

	polytope::ContactResult result;
	std::optional<Way>      way = shortestWay(*one, *other, settings(StiffnessRule::PerContact), result);
	if (!way && !result.hasGeometry) return failed(c);
	polytope::SpreadContact spread;
	if (way && !(way->deepest > 0)) {
		publish(way->deepest, 0, way->normal, way->foot + (one->margin - way->deepest / 2) * way->normal, result);
	} else if (way) {
		const TouchingPair pair { c.get(), scene, { one->convex.get(), other->convex.get() }, { state1.pos, place2 },
			{ one->rotation, other->rotation }, one->origin, 0 };
		const Support      support(*one, *other, pair, *way);
		const auto* const  known = static_cast<const PolytopeGeom*>(c->geom.get());
		press(*one, *other, *way, support, known ? known->closure.get() : nullptr, spread, result);
		if (support.share.part < 1 || (known && known->share < 1)) {
			PolytopeGeom& geom = geometry(c);
			if (!c->isReal()) geom.stiffnessRule = std::int8_t(stiffnessRuleOfNew(*scene, *c));
			giveShare(support.share.part, geom, *c, result);
		}
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
