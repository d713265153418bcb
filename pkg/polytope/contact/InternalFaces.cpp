// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/InternalFaces.hpp"

#include <src/numbers/Tolerances.hpp>

#include <algorithm>
#include <limits>

namespace yade {

namespace {

	/// A plane near the overlap, and a point just outside of it where a neighbour must be if the plane is an internal face.
	struct Candidate {
		int      plane;
		Vector3r normal;       ///< of the plane
		Real     offset;       ///< from the contact point
		Vector3r outside;      ///< from the contact point
		int      facePlane;    ///< of the face that is slid on
		Vector3r face;         ///< its normal
		Real     faceOffset;   ///< from the contact point
		int      slidingPlane; ///< of the other body's plane below it
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

	/// How deep a body may be below a face of a piece and still slide on it: within the thickness of the piece, and not as deep as half the
	/// body. Deeper, it comes from another side, or has passed through. `normal`: of the face, in the piece's axes.
	Real slidingDepth(const polytope::ConvexShape& piece, const polytope::ConvexShape& body, const Vector3r& normal)
	{
		return math::min(piece.widthAlong(normal), Real(Real(polytope::tolerance::deepestSlide) * body.inscribedRadius()));
	}

	/// Pairs of a plane i near the overlap and a face j that the other body may slide on. `outside` is reached along j, so that it keeps the
	/// contact point's height below it.
	std::vector<Candidate> candidatesOf(
	        const TouchingPair& pair, const polytope::BoundingPlanes& bounding, int piece, const std::vector<Vector3r> (&normals)[2])
	{
		std::vector<Candidate> all;
		for (int j = 0; j < bounding.count[piece]; ++j) {
			const Vector3r& face  = normals[piece][j];
			const Chord     chord = chordBelow(bounding, piece, j, normals);
			const Real      deepest
			        = slidingDepth(*pair.convex[piece], *pair.convex[1 - piece], pair.rotation[piece].transpose() * face);
			if (!(chord.length < deepest)) continue;
			for (int i = 0; i < bounding.count[piece]; ++i) {
				const Vector3r& normal = normals[piece][i];
				const Vector3r  along  = normal - normal.dot(face) * face; // along·normal = |along|²
				if (i == j || along.squaredNorm() < Real(polytope::tolerance::parallel)) continue;
				const Real way = bounding.slack[piece][i] + 2 * pair.ball;
				all.push_back(
				        { bounding.plane[piece][i], normal, bounding.slack[piece][i], way / along.squaredNorm() * along,
				                bounding.plane[piece][j], face, bounding.slack[piece][j], chord.plane });
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

	/// How far the solid goes on beyond a covered face, along its normal: to where the way from the overlap along that, within the face that
	/// is slid on, leaves the pieces that continue this one. It does not end where it leaves through a face that this piece has, too.
	Real wayBeyond(const TouchingPair& pair, int piece, const Candidate& covered, const std::vector<Solid>& others)
	{
		const Real        infinite = std::numeric_limits<Real>::infinity();
		const Vector3r    along    = covered.outside.normalized();
		const Real        step     = flushStep(pair);
		Vector3r          at       = covered.outside;
		Real              end      = infinite;
		std::vector<bool> passed(others.size(), false);
		for (bool in = true; in;) {
			in = false;
			for (std::size_t k = 0; k < others.size() && !in; ++k) {
				if (passed[k] || !contains(others[k].planes, at) || !covered.continuedBy(others[k], step)) continue;
				passed[k] = in = true;
				Real leaves = infinite, ends = infinite;
				for (const polytope::Plane& plane : others[k].planes) {
					const Real rate = plane.normal.dot(along);
					if (!(rate > Real(polytope::tolerance::parallel))) continue;
					const Real way = (plane.offset - plane.normal.dot(at)) / rate;
					leaves         = math::min(leaves, way);
					if (!isOwnNormal(plane.normal, covered.plane, pair, piece)) ends = math::min(ends, way);
				}
				if (!math::isfinite(leaves)) return infinite;
				end = (at + (math::isfinite(ends) ? ends : leaves) * along).dot(covered.normal) - covered.offset;
				at += (leaves + 2 * pair.ball) * along;
			}
		}
		return end;
	}

} // namespace

bool mayHaveInternalFaces(const Body& body1, const Body& body2) { return (isPiece(body1) || isPiece(body2)) && !inOneClump(body1, body2); }

polytope::InternalPlanes internalPlanes(const TouchingPair& pair, const polytope::BoundingPlanes& bounding)
{
	std::vector<Candidate> candidates[2];
	std::vector<Solid>     others[2];
	const Real             step = flushStep(pair);
	std::vector<Vector3r>  normals[2];
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < bounding.count[body]; ++k)
			normals[body].push_back(boundingNormal(pair, bounding, body, k));
	for (int piece = 0; piece < 2; ++piece) {
		if (bounding.count[piece] < 2 || !isPiece(bodyOf(pair, piece))) continue;
		candidates[piece] = candidatesOf(pair, bounding, piece, normals);
		if (candidates[piece].empty()) continue;
		const Real     near  = 2 * pair.convex[1 - piece]->boundingRadius(); // no overlap reaches farther
		const Vector3r mover = pair.centre[1 - piece] - pair.point;
		forOtherPieces(pair, 1 - piece, [&](const Body& neighbour, const Vector3r& centre, const Vector3r&) {
			Solid solid;
			setBody(solid, neighbour, centre, mover, near);
			if (solid.planes.empty()) return;
			for (Candidate& one : candidates[piece]) {
				one.internal    = one.internal || (contains(solid.planes, one.outside) && one.continuedBy(solid, step));
				one.faceCovered = one.faceCovered || contains(solid.planes, one.aboveFace(pair));
			}
			others[piece].push_back(std::move(solid));
		});
	}
	// neither of the two faces that slide is an internal face itself: of blocks that meet at a corner, or along an edge, no side is
	const auto covered = [&](int piece, int plane) {
		return std::any_of(candidates[piece].begin(), candidates[piece].end(),
		        [&](const Candidate& one) { return one.internal && one.plane == plane; });
	};
	polytope::InternalPlanes result;
	for (int piece = 0; piece < 2; ++piece) {
		const int& count = result.count[piece];
		for (const Candidate& one : candidates[piece]) {
			if (!one.internal || one.faceCovered || covered(piece, one.facePlane) || covered(1 - piece, one.slidingPlane))
				continue;
			const int* const first = result.plane[piece];
			if (std::find(first, first + count, one.plane) == first + count)
				result.add(piece, one.plane, wayBeyond(pair, piece, one, others[piece]));
		}
	}
	if (result.count[0] > 0 && result.count[1] > 0) result.count[1 - supportOf(pair)] = 0;
	return result;
}

} // namespace yade
