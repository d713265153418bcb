// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/InternalFaces.hpp"

#include <src/numbers/Tolerances.hpp>

#include <algorithm>
#include <limits>

namespace yade {

namespace {

	/// How far it is to an end that is not there.
	const Real noEnd = std::numeric_limits<Real>::infinity();

	/// A plane near the overlap, and a point just outside of it where a neighbour must be if the plane is an internal face.
	struct Candidate {
		int      plane;
		Vector3r normal;     ///< of the plane
		Real     offset;     ///< from the contact point
		Vector3r outside;    ///< from the contact point
		int      facePlane;  ///< of the face that is slid on
		int      faceNumber; ///< among those that bound the overlap
		Vector3r face;       ///< its normal
		Real     faceOffset; ///< from the contact point
		bool     internal    = false;
		bool     faceCovered = false; ///< a neighbour fills the place above the face, too: nothing slides on it

		/// From the contact point, beyond the face by the diameter of the largest ball in the overlap.
		Vector3r aboveFace(const TouchingPair& pair) const { return (faceOffset + 2 * pair.ball) * face; }

		/// Whether the neighbour's face continues the one that is slid on, to within `step`.
		bool continuedBy(const Solid& neighbour, Real step) const { return faceAt(neighbour, face, faceOffset * face, step); }
	};

	Vector3r boundingNormal(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int body, int k)
	{
		Vector3r own = Vector3r::Zero();
		for (int axis = 0; axis < pair.convex[body]->dimension(); ++axis)
			own[axis] = pair.convex[body]->normalArray(axis)[bounding.plane[body][k]];
		return pair.rotation[body] * own;
	}

	/// The chord of the overlap through the contact point along a normal of the piece: how deep the other body is below that plane there. It ends in
	/// none of that body's planes that are passed; infinite: in no plane of it.
	template <class Passed>
	Real chordBelow(
	        const polytope::BoundingPlanes& bounding, int piece, int j, const std::vector<Vector3r> (&normals)[2], const Passed& passed)
	{
		const int other = 1 - piece;
		Real      chord = noEnd;
		for (int k = 0; k < bounding.count[other]; ++k) {
			const Real cosine = -normals[other][k].dot(normals[piece][j]);
			if (!(cosine > 0) || passed(bounding.plane[other][k])) continue;
			chord = math::min(chord, Real(bounding.slack[piece][j] + bounding.slack[other][k] / cosine));
		}
		return chord;
	}

	/// Whether a body's plane is one of these.
	bool isAmong(const polytope::InternalPlanes& internal, int body, int plane)
	{
		const int* const first = internal.plane[body];
		const int* const end   = first + internal.count[body];
		return std::find(first, end, plane) != end;
	}

	/// How deep a body may be below a face of a piece and still slide on it: within the thickness of the piece, and not as deep as half the
	/// body. Deeper, it comes from another side, or has passed through. `normal`: of the face.
	Real slidingDepth(const TouchingPair& pair, int piece, const Vector3r& normal)
	{
		return math::min(pair.convex[piece]->widthAlong(pair.rotation[piece].transpose() * normal),
		        Real(Real(polytope::tolerance::deepestSlide) * pair.convex[1 - piece]->inscribedRadius()));
	}

	/// Pairs of a plane i near the overlap and a face j that the other body may slide on, neither of them `known` as internal. `outside` is reached along
	/// j, so that it keeps the contact point's height below it.
	std::vector<Candidate> candidatesOf(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int piece,
	        const std::vector<Vector3r> (&normals)[2], const polytope::InternalPlanes& known)
	{
		std::vector<Candidate> all;
		for (int j = 0; j < bounding.count[piece]; ++j) {
			const Vector3r& face = normals[piece][j];
			if (isAmong(known, piece, bounding.plane[piece][j])) continue;
			if (!(chordBelow(bounding, piece, j, normals, [](int) { return false; }) < slidingDepth(pair, piece, face)))
				continue;
			for (int i = 0; i < bounding.count[piece]; ++i) {
				const Vector3r& normal = normals[piece][i];
				const Vector3r  along  = normal - normal.dot(face) * face; // along·normal = |along|²
				if (i == j || along.squaredNorm() < Real(polytope::tolerance::parallel)) continue;
				if (isAmong(known, piece, bounding.plane[piece][i])) continue;
				const Real way = bounding.slack[piece][i] + 2 * pair.ball;
				all.push_back({ bounding.plane[piece][i], normal, bounding.slack[piece][i],
				        way / along.squaredNorm() * along, bounding.plane[piece][j], j, face, bounding.slack[piece][j] });
			}
		}
		return all;
	}

	/// Whether a plane of the piece, but this one, has this normal.
	bool isOwnNormal(const Vector3r& normal, int but, const TouchingPair& pair, int piece)
	{
		const polytope::HalfSpaces& own    = pair.convex[piece]->planes();
		const Vector3r              turned = pair.rotation[piece].transpose() * normal;
		for (std::size_t k = 0; k < own.size(); ++k)
			if (int(k) != but && own.normals[k].dot(turned) > 1 - Real(polytope::tolerance::parallel)) return true;
		return false;
	}

	/// One of two bodies and the other pieces of its solid, from the contact point.
	struct SolidOfPieces {
		Solid              own;
		std::vector<Solid> others;
		struct Ball {
			Vector3r centre;
			Real     radius;
		};
		std::vector<Ball> balls; ///< around all of them

		SolidOfPieces(const TouchingPair& pair, int which)
		{
			const int      other   = 1 - which;
			const bool     isAlone = !isPiece(bodyOf(pair, other));
			const Vector3r centre = pair.centre[which] - pair.point, seenFrom = pair.centre[other] - pair.point;
			setBody(own, bodyOf(pair, which), centre, seenFrom, noEnd);
			balls.push_back({ centre, pair.convex[which]->boundingRadius() });
			if (!isPiece(bodyOf(pair, which))) return;
			// the overlap with a single body reaches no farther than that
			const Real near = isAlone ? Real(2 * pair.convex[other]->boundingRadius()) : noEnd;
			forOtherPieces(pair, other, [&](const Body& neighbour, const Vector3r& place) {
				Solid solid;
				setBody(solid, neighbour, place, seenFrom, near);
				if (solid.planes.empty()) return;
				const Real radius = familyOf(*neighbour.shape).boundingRadius(*neighbour.shape);
				balls.push_back({ place, radius > 0 ? radius : noEnd }); // a wall's is not known
				others.push_back(std::move(solid));
			});
		}

		/// Whether a point is in it, or not farther than `room` out of it.
		bool holds(const Vector3r& point, const Real& room) const
		{
			const auto in = [&](const Solid& one) { return contains(one.planes, point, room); };
			return in(own) || std::any_of(others.begin(), others.end(), in);
		}

		/// Not less than how far it reaches along a direction.
		Real reach(const Vector3r& direction) const
		{
			Real farthest = -noEnd;
			for (const Ball& ball : balls)
				farthest = math::max(farthest, Real(ball.centre.dot(direction) + ball.radius));
			return farthest;
		}
	};

	/// How far the solid goes on beyond a covered face, along its normal: to where the way from the overlap along that, within the face that
	/// is slid on, leaves the pieces that continue this one. It does not end where it leaves through a face that this piece has, too, nor where `body`, which
	/// lies on it, is not any more: there its end may be elsewhere for each place of the contact point, and not all pieces are known.
	Real wayBeyond(
	        const TouchingPair& pair, int piece, const Candidate& covered, const std::vector<Solid>& others, const SolidOfPieces& body)
	{
		const Vector3r    along = covered.outside.normalized();
		const Real        step  = flushStep(pair);
		Vector3r          at = covered.outside, leftAt = at;
		Real              end = noEnd;
		std::vector<bool> passed(others.size(), false);
		for (bool in = true; in;) {
			in = false;
			for (std::size_t k = 0; k < others.size() && !in; ++k) {
				if (passed[k] || !contains(others[k].planes, at) || !covered.continuedBy(others[k], step)) continue;
				passed[k] = in = true;
				Real leaves = noEnd, ends = noEnd;
				for (const polytope::Plane& plane : others[k].planes) {
					const Real rate = plane.normal.dot(along);
					if (!(rate > Real(polytope::tolerance::parallel))) continue;
					const Real way = (plane.offset - plane.normal.dot(at)) / rate;
					leaves         = math::min(leaves, way);
					if (!isOwnNormal(plane.normal, covered.plane, pair, piece)) ends = math::min(ends, way);
				}
				if (!math::isfinite(leaves)) return noEnd;
				end    = (at + (math::isfinite(ends) ? ends : leaves) * along).dot(covered.normal) - covered.offset;
				leftAt = at + leaves * along;
				at     = leftAt + 2 * pair.ball * along;
			}
		}
		// blocks often end where their neighbours do, but for an overlap
		if (body.holds(leftAt, 4 * pair.ball)) return end;
		return math::max(end, Real(body.reach(covered.normal) - covered.offset));
	}

	/// Slacks at the pair's point: the solids' overlap may have its centre far from the pieces, from where the way out of a support is another one.
	void moveSlacks(polytope::BoundingPlanes& bounding, const TouchingPair& pair)
	{
		const Vector3r way = pair.centre[0] + bounding.point - pair.point;
		for (int body = 0; body < 2; ++body)
			for (int k = 0; k < bounding.count[body]; ++k)
				bounding.slack[body][k] += boundingNormal(pair, bounding, body, k).dot(way);
		bounding.point -= way;
	}

	/// Adds those that the planes which bound the overlap show, beside those found before; true if there were some.
	bool addInternalPlanes(const TouchingPair& pair, const polytope::BoundingPlanes& bounding, polytope::InternalPlanes& found)
	{
		const polytope::InternalPlanes known = found;
		std::vector<Candidate>         candidates[2];
		const Real                     step = flushStep(pair);
		std::vector<Vector3r>          normals[2];
		for (int body = 0; body < 2; ++body)
			for (int k = 0; k < bounding.count[body]; ++k)
				normals[body].push_back(boundingNormal(pair, bounding, body, k));
		for (int piece = 0; piece < 2; ++piece) {
			if (bounding.count[piece] < 2 || !isPiece(bodyOf(pair, piece))) continue;
			candidates[piece] = candidatesOf(pair, bounding, piece, normals, known);
		}
		if (candidates[0].empty() && candidates[1].empty()) return false;
		const SolidOfPieces solids[] = { { pair, 0 }, { pair, 1 } };
		for (int piece = 0; piece < 2; ++piece)
			for (const Solid& solid : solids[piece].others)
				for (Candidate& one : candidates[piece]) {
					one.internal
					        = one.internal || (contains(solid.planes, one.outside) && one.continuedBy(solid, step));
					one.faceCovered = one.faceCovered || contains(solid.planes, one.aboveFace(pair));
				}
		// neither of the two faces that slide is an internal face itself: of blocks that meet at a corner, or along an edge, no side is
		const auto covered = [&](int piece, int plane) {
			return std::any_of(candidates[piece].begin(), candidates[piece].end(),
			        [&](const Candidate& one) { return one.internal && one.plane == plane; });
		};
		bool added = false;
		for (int piece = 0; piece < 2; ++piece)
			for (const Candidate& one : candidates[piece]) {
				if (!one.internal || one.faceCovered || covered(piece, one.facePlane) || isAmong(found, piece, one.plane))
					continue;
				const auto passed = [&](int plane) { return covered(1 - piece, plane); };
				if (!(chordBelow(bounding, piece, one.faceNumber, normals, passed) < slidingDepth(pair, piece, one.face)))
					continue;
				if (found.count[piece] == polytope::BoundingPlanes::most) continue;
				found.add(piece, one.plane, wayBeyond(pair, piece, one, solids[piece].others, solids[1 - piece]));
				added = true;
			}
		return added;
	}

} // namespace

bool mayHaveInternalFaces(const Body& body1, const Body& body2) { return (isPiece(body1) || isPiece(body2)) && !inOneClump(body1, body2); }

InternalFaces::InternalFaces(const TouchingPair& pair, const polytope::PlacedPair& placed, polytope::ContactSettings settings,
        polytope::PairMemory memory, polytope::ContactWorkspace& workspace)
{
	polytope::BoundingPlanes& bounding = *settings.bounding;
	if (!addInternalPlanes(pair, bounding, planes) || !isPiece(bodyOf(pair, 0)) || !isPiece(bodyOf(pair, 1))) return;
	queried                   = true;
	settings.internal         = &planes;
	settings.boundingOfSolids = true;
	settings.linear           = nullptr;
	settings.outline = settings.section = settings.energy = false;
	polytope::ContactResult result;
	do {
		polytope::contactQuery(placed, settings, memory, workspace, result);
		moveSlacks(bounding, pair);
	} while (result.inContact && addInternalPlanes(pair, bounding, planes));
}

} // namespace yade
