// SPDX-License-Identifier: GPL-2.0-or-later
#include "InternalFaces.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Wall.hpp>

#include <src/contact/SectionArea.hpp>

#include "Polytope.hpp"

#include <algorithm>

namespace yade {

namespace {

	using Planes = std::vector<polytope::Plane>; ///< world axes, offsets from the contact point

	const Body& bodyOf(const TouchingPair& pair, int which)
	{
		return *Body::byId(which == 0 ? pair.contact->getId1() : pair.contact->getId2(), pair.scene);
	}

	void addPlane(Planes& planes, const Vector3r& normal, Real offset) { planes.push_back({ normal, offset }); }

	void addPlanes(Planes& planes, const polytope::ConvexShape& convex, const Matrix3r& rotation, const Vector3r& centre)
	{
		for (int i = 0; i < convex.planeCount(); ++i) {
			Vector3r own = Vector3r::Zero();
			for (int k = 0; k < convex.dimension(); ++k)
				own[k] = convex.normalArray(k)[i];
			const Vector3r normal = rotation * own;
			addPlane(planes, normal, convex.offsetArray()[i] + normal.dot(centre));
		}
	}

	/// Half-spaces of a body whose centre is at `centre` from the contact point, as a body whose centre is at `other` meets it. None for
	/// shapes without faces, and for bodies farther than `near` from the contact point.
	void addBody(Planes& planes, const Body& body, const Vector3r& centre, const Vector3r& other, Real near)
	{
		const Matrix3r rotation = body.state->ori.toRotationMatrix();
		const Shape*   shape    = body.shape.get();
		if (const auto* solid = dynamic_cast<const Polytope*>(shape)) {
			const auto& convex = solid->convex();
			if (convex && centre.norm() < convex->boundingRadius() + near) addPlanes(planes, *convex, rotation, centre);
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

	/// Whether two bodies move as one, or not at all: they never touch.
	bool rigidTogether(const Body& one, const Body& other)
	{
		if (one.isClumpMember() || other.isClumpMember()) return one.clumpId == other.clumpId;
		return !one.isDynamic() && !other.isDynamic();
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
		for (const auto& [id, contact] : body.intrs) {
			if (id == own.id || !contact) continue;
			const shared_ptr<Body>& piece = Body::byId(id, pair.scene);
			if (!piece || !piece->shape || !piece->maskOk(body.groupMask) || !rigidTogether(*piece, own)) continue;
			Vector3r way = piece->state->pos - body.state->pos;
			if (pair.scene->isPeriodic) {
				const Vector3r shift = pair.scene->cell->intrShiftPos(contact->cellDist);
				way += contact->getId2() == id ? shift : Vector3r(-shift);
			}
			visit(*piece, Vector3r(centre + way));
		}
	}

	/// A plane that bounds the overlap, and a point just outside of it where a neighbour must be if the plane is an internal face.
	struct Candidate {
		int      plane;
		Vector3r outside;      ///< from the contact point
		int      facePlane;    ///< of the face that is slid on
		Vector3r face;         ///< its normal
		Real     faceOffset;   ///< from the contact point
		int      slidingPlane; ///< of the other body's face that lies on it
		Real     depth;        ///< of that face below this one
		bool     covered, carried;

		bool internal() const { return covered && carried; }

		/// Whether the neighbour's face continues the one that is slid on, to within `step`.
		bool continuedBy(const Planes& neighbour, Real step) const
		{
			return std::any_of(neighbour.begin(), neighbour.end(), [&](const polytope::Plane& plane) {
				return plane.normal.dot(face) > 1 - Real(polytope::tolerance::parallel)
				        && math::abs(plane.offset - faceOffset) <= step;
			});
		}
	};

	/// Whether a ball of this radius was found inside all planes: from `start` to the nearest place inside the plane that is violated most,
	/// and a little further, some times over. Where the result is false there may still be such a ball in a narrow space.
	bool hasRoom(const Planes& one, const Planes& other, Vector3r start, Real radius)
	{
		for (int step = 0; step < polytope::tolerance::mostProjections; ++step) {
			const polytope::Plane* worst     = nullptr;
			Real                   violation = 0;
			for (const Planes* planes : { &one, &other })
				for (const polytope::Plane& plane : *planes) {
					const Real out = plane.normal.dot(start) + radius - plane.offset;
					if (out > violation) {
						violation = out;
						worst     = &plane;
					}
				}
			if (!worst) return true;
			start -= Real(polytope::tolerance::overProjection) * violation * worst->normal;
		}
		return false;
	}

	Vector3r boundingNormal(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int body, int k)
	{
		Vector3r own = Vector3r::Zero();
		for (int axis = 0; axis < pair.convex[body]->dimension(); ++axis)
			own[axis] = pair.convex[body]->normalArray(axis)[bounding.plane[body][k]];
		return pair.rotation[body] * own;
	}

	/// The other body's face that lies on plane j of the piece, by far less than either body is thick: edges and vertices are not stopped by
	/// seams. −1 if there is none.
	int slidingPlane(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int piece, int j, Real& depth)
	{
		const Real thin = Real(polytope::tolerance::thinContact)
		        * math::min(pair.convex[0]->inscribedRadius(), pair.convex[1]->inscribedRadius());
		const Vector3r face = boundingNormal(pair, bounding, piece, j);
		for (int k = 0; k < bounding.count[1 - piece]; ++k)
			if (boundingNormal(pair, bounding, 1 - piece, k).dot(face) < Real(polytope::tolerance::parallel) - 1
			        && (depth = bounding.slack[piece][j] + bounding.slack[1 - piece][k]) < thin)
				return bounding.plane[1 - piece][k];
		return -1;
	}

	/// Pairs of a plane i that bounds the overlap and a face j that the other body may slide on. `outside` is reached along j, so that it keeps
	/// the contact point's height below it.
	std::vector<Candidate> candidatesOf(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int piece)
	{
		std::vector<Candidate> all;
		for (int j = 0; j < bounding.count[piece]; ++j) {
			Real      depth;
			const int plane = slidingPlane(pair, bounding, piece, j, depth);
			if (plane < 0) continue;
			const Vector3r face = boundingNormal(pair, bounding, piece, j);
			for (int i = 0; i < bounding.count[piece]; ++i) {
				if (i == j || !bounding.bounds(piece, i)) continue;
				const Vector3r normal = boundingNormal(pair, bounding, piece, i);
				const Vector3r along  = normal - normal.dot(face) * face; // along·normal = |along|²
				if (along.squaredNorm() < Real(polytope::tolerance::parallel)) continue;
				const Real way = bounding.slack[piece][i] + 2 * pair.ball;
				all.push_back({ bounding.plane[piece][i], way / along.squaredNorm() * along, bounding.plane[piece][j], face,
				        bounding.slack[piece][j], plane, depth, false,
				        pair.ball >= Real(polytope::tolerance::carriedBall) * depth });
			}
		}
		return all;
	}

} // namespace

bool mayHaveInternalFaces(const Body& body1, const Body& body2)
{
	return (isPiece(body1) || isPiece(body2)) && !rigidTogether(body1, body2);
}

polytope::InternalPlanes internalPlanes(const TouchingPair& pair, const polytope::BoundingPlanes& bounding)
{
	std::vector<Candidate> candidates[2];
	Planes                 planes, own;
	const Real             larger = math::max(pair.convex[0]->boundingRadius(), pair.convex[1]->boundingRadius());
	const Real             step   = math::max(pair.ball, Real(polytope::tolerance::flush) * larger);
	for (int piece = 0; piece < 2; ++piece) {
		if (bounding.count[piece] < 2 || !isPiece(bodyOf(pair, piece))) continue;
		candidates[piece] = candidatesOf(pair, bounding, piece);
		if (candidates[piece].empty()) continue;
		Real near = 0;
		for (const Candidate& one : candidates[piece])
			near = math::max(near, one.outside.norm());
		const Vector3r mover = pair.centre[1 - piece] - pair.point;
		own.clear();
		addPlanes(own, *pair.convex[1 - piece], pair.rotation[1 - piece], mover);
		forOtherPieces(pair, 1 - piece, [&](const Body& neighbour, const Vector3r& centre) {
			planes.clear();
			addBody(planes, neighbour, centre, mover, near);
			for (Candidate& one : candidates[piece]) {
				if (one.internal() || !one.continuedBy(planes, step)) continue;
				one.covered = one.covered || contains(planes, one.outside);
				one.carried = one.carried
				        || hasRoom(planes, own, one.outside, Real(polytope::tolerance::carriedBall) * one.depth);
			}
		});
	}
	// neither of the two faces that slide is an internal face itself: of blocks that meet at a corner, or along an edge, no side is
	const auto covered = [&](int piece, int plane) {
		return std::any_of(candidates[piece].begin(), candidates[piece].end(),
		        [&](const Candidate& one) { return one.internal() && one.plane == plane; });
	};
	polytope::InternalPlanes result;
	for (int piece = 0; piece < 2; ++piece) {
		int& count = result.count[piece];
		for (const Candidate& one : candidates[piece]) {
			if (!one.internal() || covered(piece, one.facePlane) || covered(1 - piece, one.slidingPlane)) continue;
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
		Planes                       planes;
		addPlanes(planes, convex, pair.rotation[1 - piece], mover);
		const std::size_t covered = planes.size();
		const auto        areaOn  = [&](const Body& body, const Vector3r& centre) {
                        planes.resize(covered);
                        addBody(planes, body, centre, mover, reach);
                        if (planes.size() == covered) return Real(0);
                        return polytope::sectionArea(planes, pair.normal, reach, convex.dimension());
		};
		const Real here = areaOn(bodyOf(pair, piece), pair.centre[piece] - pair.point);
		Real       all  = here;
		forOtherPieces(pair, 1 - piece, [&](const Body& other, const Vector3r& centre) { all += areaOn(other, centre); });
		if (all > 0) return math::max(here / all, Real(polytope::tolerance::leastShareOfSupport));
	}
	return 1;
}

} // namespace yade
