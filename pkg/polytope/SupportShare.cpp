// SPDX-License-Identifier: GPL-2.0-or-later
#include "SupportShare.hpp"

#include <src/contact/SectionArea.hpp>

#include <algorithm>
#include <limits>

namespace yade {

namespace {

	/// Whether a face of one piece that looks up continues one of the other: the two slopes of a ridge have none in common.
	bool haveCommonFace(const Solid& one, const Solid& other, const Vector3r& up, const Real& step)
	{
		for (std::size_t i = 0; i < one.faces; ++i)
			for (std::size_t j = 0; j < other.faces; ++j) {
				const polytope::Plane &a = one.planes[i], &b = other.planes[j];
				if (a.normal.dot(up) > Real(polytope::tolerance::parallel)
				        && a.normal.dot(b.normal) > 1 - Real(polytope::tolerance::parallel)
				        && math::abs(a.offset - b.offset) <= step)
					return true;
			}
		return false;
	}

	/// Where an edge or a vertex of a piece lies deepest in the other body, and another piece has it too: a ridge or a tip that is made of pieces.
	struct Ridge {
		Vector3r point;     ///< from the contact point
		Real     depth = 0; ///< of the other body's surface below it; 0: there is no ridge
	};

	bool isInternal(const polytope::InternalPlanes& internal, int piece, int plane)
	{
		const int* const first = internal.plane[piece];
		return std::find(first, first + internal.count[piece], plane) != first + internal.count[piece];
	}

	/// Planes of a body of the pair.
	Planes planesOf(const TouchingPair& pair, int body)
	{
		Planes planes;
		polytope::addPlanesOf({ *pair.convex[body], pair.centre[body] - pair.point, pair.rotation[body] }, planes);
		return planes;
	}

	/// From a point along a direction out of half-spaces.
	Real wayOut(const Planes& planes, const Vector3r& point, const Vector3r& direction)
	{
		Real way = std::numeric_limits<Real>::infinity();
		for (const polytope::Plane& plane : planes) {
			const Real cosine = plane.normal.dot(direction);
			if (cosine > 0) way = math::min(way, Real((plane.offset - plane.normal.dot(point)) / cosine));
		}
		return way;
	}

	/// The part of a line that lies in half-spaces, from `first` to `last` along its direction.
	struct Stretch {
		Vector3r from, direction;
		Real     first = -std::numeric_limits<Real>::infinity(), last = std::numeric_limits<Real>::infinity();

		void cut(const polytope::Plane& plane, const Real& room)
		{
			const Real rise = plane.normal.dot(direction), left = plane.offset + room - plane.normal.dot(from);
			if (rise > 0) last = math::min(last, Real(left / rise));
			else if (rise < 0) first = math::max(first, Real(left / rise));
			else if (left < 0) last = -std::numeric_limits<Real>::infinity();
		}
		bool     any() const { return first <= last; }
		Vector3r at(const Real& place) const { return from + place * direction; }
		/// To the origin.
		Vector3r nearest() const { return at(math::max(first, math::min(last, Real(-from.dot(direction) / direction.squaredNorm())))); }
	};

	/// None for a contact on a face of the piece. Edges go on over internal faces, beyond which another piece continues them.
	Ridge deepestRidge(const TouchingPair& pair, const polytope::InternalPlanes& internal, int piece, const Planes& own, const Planes& mover)
	{
		const Vector3r up     = piece == 0 ? pair.normal : Vector3r(-pair.normal);
		const Real     rest   = Real(polytope::tolerance::flush) * math::max(pair.convex[0]->boundingRadius(), pair.convex[1]->boundingRadius());
		const Real     beside = Real(polytope::tolerance::besideSeam) * pair.ball + rest;
		if (std::any_of(own.begin(), own.end(), [&](const polytope::Plane& plane) { return plane.normal.dot(up) > 1 - Real(polytope::tolerance::parallel); }))
			return {};
		const auto&            surface = pair.convex[piece]->polyhedron();
		const Vector3r         down    = -up;
		std::vector<Ridge>     ridges;
		std::vector<Vector3r>  corners;
		std::vector<Real>      depths; // of the corners, if each edge that begins there leaves the other body through what is below; else 0
		for (const Vector3r& corner : surface.vertices) {
			corners.push_back(pair.centre[piece] - pair.point + pair.rotation[piece] * corner);
			depths.push_back(contains(mover, corners.back()) ? wayOut(mover, corners.back(), down) : Real(0));
		}
		for (const auto& face : surface.faces)
			for (std::size_t k = 0; k < face.size(); ++k) {
				const auto one = std::size_t(face[k]), two = std::size_t(face[(k + 1) % face.size()]);
				if (one > two) continue; // of the face beyond it
				Stretch edge { corners[one], corners[two] - corners[one] };
				for (const polytope::Plane& plane : mover)
					edge.cut(plane, 0);
				const auto leaves = [&](const Real& end) { return wayOut(mover, edge.at(end), down); };
				if (depths[one] > 0 && leaves(math::min(edge.last, Real(1))) > Real(polytope::tolerance::besideSeam) * depths[one])
					depths[one] = 0;
				if (depths[two] > 0 && leaves(math::max(edge.first, Real(0))) > Real(polytope::tolerance::besideSeam) * depths[two])
					depths[two] = 0;
				for (std::size_t i = 0; i < own.size() && edge.any(); ++i)
					if (!isInternal(internal, piece, int(i))) edge.cut(own[i], rest);
				if (!edge.any()) continue;
				const Vector3r point = edge.nearest();
				const Real     depth = wayOut(mover, point, down);
				if (depth > 0 && math::isfinite(depth)) ridges.push_back({ point, depth });
			}
		for (std::size_t k = 0; k < corners.size(); ++k)
			if (depths[k] > 0 && math::isfinite(depths[k])) ridges.push_back({ corners[k], depths[k] });
		if (ridges.empty()) return {};
		std::vector<bool> shared(ridges.size());
		Solid          solid;
		const Real     near   = 2 * pair.convex[1 - piece]->boundingRadius();
		const Vector3r centre = pair.centre[1 - piece] - pair.point;
		forOtherPieces(pair, 1 - piece, [&](const Body& neighbour, const Vector3r& at, const Vector3r& shift) {
			setMitred(solid, neighbour, at, bodyOf(pair, 1 - piece), centre, shift, near, *pair.scene);
			for (std::size_t k = 0; k < ridges.size(); ++k)
				shared[k] = shared[k] || contains(solid.planes, ridges[k].point, beside);
		});
		Ridge deepest;
		for (std::size_t k = 0; k < ridges.size(); ++k)
			if (shared[k] && ridges[k].depth > deepest.depth) deepest = ridges[k];
		return deepest;
	}

} // namespace

SupportShare shareOfSupport(const TouchingPair& pair, const polytope::InternalPlanes& internal)
{
	for (int piece = 0; piece < 2; ++piece) {
		if (!isPiece(bodyOf(pair, piece))) continue;
		const polytope::ConvexShape& convex = *pair.convex[1 - piece];
		const Vector3r               centre = pair.centre[1 - piece] - pair.point;
		const Real                   reach  = 2 * convex.boundingRadius();
		const Vector3r               up     = piece == 0 ? pair.normal : Vector3r(-pair.normal);
		const Real                   step   = flushStep(pair);
		const Planes                 planes = planesOf(pair, piece);
		Planes                       mover  = planesOf(pair, 1 - piece);
		const Ridge                  ridge  = deepestRidge(pair, internal, piece, planes, mover);
		const bool                   onRidge = ridge.depth > 0;
		if (internal.count[piece] == 0 && !onRidge) continue;

		SupportShare result;
		result.depth         = ridge.depth;
		const Vector3r place = onRidge ? Vector3r(ridge.point - ridge.depth / 2 * up) : Vector3r::Zero(); // where areas are compared
		Solid             own, others;
		const std::size_t covered = mover.size();
		const auto        areaOn  = [&](const Planes& solid) {
                        if (solid.empty()) return Real(0);
                        mover.resize(covered, { up, 0 });
                        mover.insert(mover.end(), solid.begin(), solid.end());
                        for (polytope::Plane& plane : mover)
                                plane.offset -= plane.normal.dot(place);
                        const Real area = polytope::sectionArea(mover, pair.normal, reach, convex.dimension());
                        for (polytope::Plane& plane : mover)
                                plane.offset += plane.normal.dot(place);
                        return area;
		};
		setBody(own, bodyOf(pair, piece), pair.centre[piece] - pair.point, centre, reach);
		if (onRidge) own.planes = planes; // as the contact has it
		const Real here = areaOn(own.planes);
		Real       all  = here;
		const Real room = Real(polytope::tolerance::besideSeam) * pair.ball;
		std::vector<Solid> found { own }, rest;
		forOtherPieces(pair, 1 - piece, [&](const Body& other, const Vector3r& at, const Vector3r& shift) {
			if (onRidge) setMitred(others, other, at, bodyOf(pair, 1 - piece), centre, shift, reach, *pair.scene);
			else setBody(others, other, at, centre, reach);
			rest.push_back(others);
		});
		const auto belongs = [&](const Solid& solid, std::size_t upTo) {
			if (onRidge && contains(solid.planes, ridge.point, room)) return true;
			for (std::size_t k = 0; k < upTo; ++k)
				if (haveCommonFace(found[k], solid, up, step)) return true;
			return false;
		};
		// on a ridge, those that continue the face of another one, too
		for (std::size_t before = 0; before < found.size();) {
			before = found.size();
			for (auto one = rest.begin(); one != rest.end();) {
				if (belongs(*one, onRidge ? before : 1)) {
					all += areaOn(one->planes);
					found.push_back(std::move(*one));
					one = rest.erase(one);
				} else ++one;
			}
		}
		if (!(all > 0)) continue;
		result.share = math::max(here / all, Real(polytope::tolerance::leastShareOfSupport));
		return result;
	}
	return {};
}

} // namespace yade
