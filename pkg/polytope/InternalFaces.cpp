// SPDX-License-Identifier: GPL-2.0-or-later
#include "InternalFaces.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Wall.hpp>

#include <src/contact/SectionArea.hpp>
#include <src/shape/PlacedShape.hpp>

#include "Partners.hpp"
#include "Polytope.hpp"

#include <algorithm>
#include <limits>

namespace yade {

namespace {

	using Planes = std::vector<polytope::Plane>; ///< world axes, offsets from the contact point

	const Body& bodyOf(const TouchingPair& pair, int which)
	{
		return *Body::byId(which == 0 ? pair.contact->getId1() : pair.contact->getId2(), pair.scene);
	}

	void addPlane(Planes& planes, const Vector3r& normal, Real offset) { planes.push_back({ normal, offset }); }

	/// Half-spaces of a body whose centre is at `centre` from the contact point, as a body whose centre is at `other` meets it. None for
	/// shapes without faces, and for bodies farther than `near` from the contact point.
	void addBody(Planes& planes, const Body& body, const Vector3r& centre, const Vector3r& other, Real near)
	{
		const Matrix3r rotation = body.state->ori.toRotationMatrix();
		const Shape*   shape    = body.shape.get();
		if (const auto* solid = dynamic_cast<const Polytope*>(shape)) {
			const auto& convex = solid->convex();
			if (convex && centre.norm() < convex->boundingRadius() + near)
				polytope::addPlanesOf({ *convex, centre, rotation }, planes);
		} else if (const auto* box = dynamic_cast<const Box*>(shape)) {
			if (!(centre.norm() < box->extents.norm() + near)) return;
			for (int k = 0; k < 3; ++k)
				for (int sign = -1; sign <= 1; sign += 2) {
					const Vector3r normal = sign * rotation.col(k);
					addPlane(planes, normal, box->extents[k] + normal.dot(centre));
				}
		} else if (const auto* facet = dynamic_cast<const Facet*>(shape)) {
			// as deep as necessary, on the side away from the other body
			Vector3r corner[3];
			for (int k = 0; k < 3; ++k)
				corner[k] = centre + rotation * facet->vertices[k];
			Vector3r normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
			if (normal.dot(other - corner[0]) < 0) normal = -normal;
			addPlane(planes, normal, normal.dot(corner[0]));
			for (int k = 0; k < 3; ++k) {
				Vector3r out = (corner[(k + 1) % 3] - corner[k]).cross(normal).normalized();
				if (out.dot(corner[(k + 2) % 3] - corner[k]) > 0) out = -out;
				addPlane(planes, out, out.dot(corner[k]));
			}
		} else if (const auto* wall = dynamic_cast<const Wall*>(shape)) {
			const Real     side   = wall->sense != 0 ? Real(wall->sense) : other[wall->axis] - centre[wall->axis];
			const Vector3r normal = (side < 0 ? -1 : 1) * Vector3r::Unit(wall->axis);
			addPlane(planes, normal, normal.dot(centre));
		}
	}

	bool contains(const Planes& planes, const Vector3r& point)
	{
		for (const polytope::Plane& plane : planes)
			if (!(plane.normal.dot(point) <= plane.offset)) return false;
		return !planes.empty();
	}

	/// Whether it does not move: a body that is not dynamic, or a member of a clump that is not.
	bool isFixed(const Body& body, Scene& scene)
	{
		if (!body.isClumpMember()) return !body.isDynamic();
		const shared_ptr<Body>& clump = Body::byId(body.clumpId, &scene);
		return clump && !clump->isDynamic();
	}

	/// Whether two bodies move as one, or not at all: they never touch.
	bool rigidTogether(const Body& one, const Body& other, Scene& scene)
	{
		if (one.isClumpMember() && other.isClumpMember() && one.clumpId == other.clumpId) return true;
		return isFixed(one, scene) && isFixed(other, scene);
	}

	/// Fixed, or a member of a clump: it may be a piece of a larger solid.
	bool isPiece(const Body& body) { return body.isClumpMember() || !body.isDynamic(); }

	/// Calls visit(neighbour, its centre from the contact point) for the other pieces of the rigid support that body `mover` of the pair may touch:
	/// they are in its list of pairs.
	template <class Visit> void forOtherPieces(const TouchingPair& pair, int mover, const Visit& visit)
	{
		const Body&    body   = bodyOf(pair, mover);
		const Body&    own    = bodyOf(pair, 1 - mover);
		const Vector3r centre = pair.centre[mover] - pair.point;
		forPartners(body, own.id, *pair.scene, [&](const Body& piece, const Vector3r& shift) {
			if (!rigidTogether(piece, own, *pair.scene)) return;
			const Vector3r way = piece.state->pos - body.state->pos + shift;
			visit(piece, Vector3r(centre + way));
		});
	}

	/// How high a step between two faces is that count as one.
	Real flushStep(const TouchingPair& pair)
	{
		const Real larger = math::max(pair.convex[0]->boundingRadius(), pair.convex[1]->boundingRadius());
		return math::max(pair.ball, Real(polytope::tolerance::flush) * larger);
	}

	/// Whether a face of one piece that looks up continues one of the other: the two slopes of a ridge have none in common.
	bool haveCommonFace(const Planes& one, const Planes& other, const Vector3r& up, const Real& step)
	{
		for (const polytope::Plane& a : one)
			for (const polytope::Plane& b : other)
				if (a.normal.dot(up) > Real(polytope::tolerance::parallel)
				        && a.normal.dot(b.normal) > 1 - Real(polytope::tolerance::parallel)
				        && math::abs(a.offset - b.offset) <= step)
					return true;
		return false;
	}

	/// A plane near the overlap, and a point just outside of it where a neighbour must be if the plane is an internal face.
	struct Candidate {
		int      plane;
		Vector3r outside;      ///< from the contact point
		int      facePlane;    ///< of the face that is slid on
		Vector3r face;         ///< its normal
		Real     faceOffset;   ///< from the contact point
		int      slidingPlane; ///< of the other body's plane below it
		bool     internal;

		/// Whether the neighbour's face continues the one that is slid on, to within `step`.
		bool continuedBy(const Planes& neighbour, Real step) const
		{
			return std::any_of(neighbour.begin(), neighbour.end(), [&](const polytope::Plane& plane) {
				return plane.normal.dot(face) > 1 - Real(polytope::tolerance::parallel)
				        && math::abs(plane.offset - faceOffset) <= step;
			});
		}
	};

	Vector3r boundingNormal(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int body, int k)
	{
		Vector3r own = Vector3r::Zero();
		for (int axis = 0; axis < pair.convex[body]->dimension(); ++axis)
			own[axis] = pair.convex[body]->normalArray(axis)[bounding.plane[body][k]];
		return pair.rotation[body] * own;
	}

	/// The chord of the overlap through the contact point along a normal of the piece: how deep the other body is below that plane there.
	struct Chord {
		Real length;     ///< infinite if it ends in no plane of the other body
		int  plane = -1; ///< of the other body where it ends
	};

	Chord chordBelow(const polytope::BoundingPlanes& bounding, int piece, int j, const std::vector<Vector3r> (&normals)[2])
	{
		const int other = 1 - piece;
		Chord     chord;
		chord.length = std::numeric_limits<Real>::infinity();
		for (int k = 0; k < bounding.count[other]; ++k) {
			const Real cosine = -normals[other][k].dot(normals[piece][j]);
			if (!(cosine > 0)) continue;
			const Real length = bounding.slack[piece][j] + bounding.slack[other][k] / cosine;
			if (!(length < chord.length)) continue;
			chord.length = length;
			chord.plane  = bounding.plane[other][k];
		}
		return chord;
	}

	/// Pairs of a plane i near the overlap and a face j that the other body may slide on. `outside` is reached along j, so that it keeps the
	/// contact point's height below it.
	std::vector<Candidate> candidatesOf(
	        const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int piece, const std::vector<Vector3r> (&normals)[2])
	{
		const Real thin = Real(polytope::tolerance::thinContact)
		        * math::min(pair.convex[0]->inscribedRadius(), pair.convex[1]->inscribedRadius());
		std::vector<Candidate> all;
		for (int j = 0; j < bounding.count[piece]; ++j) {
			const Chord chord = chordBelow(bounding, piece, j, normals);
			if (!(chord.length < thin)) continue;
			const Vector3r& face = normals[piece][j];
			for (int i = 0; i < bounding.count[piece]; ++i) {
				const Vector3r& normal = normals[piece][i];
				const Vector3r  along  = normal - normal.dot(face) * face; // along·normal = |along|²
				if (i == j || along.squaredNorm() < Real(polytope::tolerance::parallel)) continue;
				const Real way = bounding.slack[piece][i] + 2 * pair.ball;
				all.push_back({ bounding.plane[piece][i], way / along.squaredNorm() * along, bounding.plane[piece][j], face,
				        bounding.slack[piece][j], chord.plane, false });
			}
		}
		return all;
	}

} // namespace

bool mayHaveInternalFaces(const Body& body1, const Body& body2, Scene& scene)
{
	return (isPiece(body1) || isPiece(body2)) && !rigidTogether(body1, body2, scene);
}

polytope::InternalPlanes internalPlanes(const TouchingPair& pair, const polytope::BoundingPlanes& bounding)
{
	std::vector<Candidate> candidates[2];
	Planes                 planes;
	const Real             step = flushStep(pair);
	std::vector<Vector3r>  normals[2];
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < bounding.count[body]; ++k)
			normals[body].push_back(boundingNormal(pair, bounding, body, k));
	for (int piece = 0; piece < 2; ++piece) {
		if (bounding.count[piece] < 2 || !isPiece(bodyOf(pair, piece))) continue;
		candidates[piece] = candidatesOf(pair, bounding, piece, normals);
		if (candidates[piece].empty()) continue;
		Real near = 0;
		for (const Candidate& one : candidates[piece])
			near = math::max(near, one.outside.norm());
		const Vector3r mover = pair.centre[1 - piece] - pair.point;
		forOtherPieces(pair, 1 - piece, [&](const Body& neighbour, const Vector3r& centre) {
			planes.clear();
			addBody(planes, neighbour, centre, mover, near);
			for (Candidate& one : candidates[piece])
				one.internal = one.internal || (contains(planes, one.outside) && one.continuedBy(planes, step));
		});
	}
	// neither of the two faces that slide is an internal face itself: of blocks that meet at a corner, or along an edge, no side is
	const auto covered = [&](int piece, int plane) {
		return std::any_of(candidates[piece].begin(), candidates[piece].end(),
		        [&](const Candidate& one) { return one.internal && one.plane == plane; });
	};
	polytope::InternalPlanes result;
	for (int piece = 0; piece < 2; ++piece) {
		int& count = result.count[piece];
		for (const Candidate& one : candidates[piece]) {
			if (!one.internal || covered(piece, one.facePlane) || covered(1 - piece, one.slidingPlane)) continue;
			int* const end = result.plane[piece] + count;
			if (std::find(result.plane[piece], end, one.plane) == end) result.plane[piece][count++] = one.plane;
		}
	}
	return result;
}

Real shareOfSupport(const TouchingPair& pair, const polytope::InternalPlanes& internal)
{
	for (int piece = 0; piece < 2; ++piece) {
		if (internal.count[piece] == 0) continue;
		const polytope::ConvexShape& convex = *pair.convex[1 - piece];
		const Vector3r               mover  = pair.centre[1 - piece] - pair.point;
		const Real                   reach  = 2 * convex.boundingRadius();
		const Vector3r               up     = piece == 0 ? pair.normal : Vector3r(-pair.normal);
		const Real                   step   = flushStep(pair);
		Planes                       planes, own, others;
		polytope::addPlanesOf({ convex, mover, pair.rotation[1 - piece] }, planes);
		const std::size_t covered = planes.size();
		const auto        areaOn  = [&](const Planes& solid) {
                        if (solid.empty()) return Real(0);
                        planes.resize(covered);
                        planes.insert(planes.end(), solid.begin(), solid.end());
                        return polytope::sectionArea(planes, pair.normal, reach, convex.dimension());
		};
		addBody(own, bodyOf(pair, piece), pair.centre[piece] - pair.point, mover, reach);
		const Real here = areaOn(own);
		Real       all  = here;
		forOtherPieces(pair, 1 - piece, [&](const Body& other, const Vector3r& centre) {
			others.clear();
			addBody(others, other, centre, mover, reach);
			if (haveCommonFace(own, others, up, step)) all += areaOn(others);
		});
		if (all > 0) return math::max(here / all, Real(polytope::tolerance::leastShareOfSupport));
	}
	return 1;
}

} // namespace yade
