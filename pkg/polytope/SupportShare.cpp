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

	/// A piece of a support and the body on it.
	struct OnPiece {
		const TouchingPair&             pair;
		const polytope::InternalPlanes& internal;
		int                             piece; ///< of the pair's two bodies
		Vector3r                        up;    ///< from the piece
		Planes                          own, mover {};

		OnPiece(const TouchingPair& touching, const polytope::InternalPlanes& left, int which)
		        : pair(touching), internal(left), piece(which), up(which == 0 ? touching.normal : Vector3r(-touching.normal)),
		          own(planesOf(which))
		{
		}
		Planes planesOf(int body) const
		{
			Planes planes;
			polytope::addPlanesOf({ *pair.convex[body], pair.centre[body] - pair.point, pair.rotation[body] }, planes);
			return planes;
		}
		const Body& moving() const { return bodyOf(pair, 1 - piece); }
		Vector3r    centre() const { return pair.centre[1 - piece] - pair.point; }
		Real        reach() const { return 2 * pair.convex[1 - piece]->boundingRadius(); }
		/// So near to a piece, a place counts as in it.
		Real beside() const { return Real(polytope::tolerance::besideSeam) * pair.ball + rest(); }
		Real rest() const
		{
			return Real(polytope::tolerance::flush)
			        * math::max(pair.convex[0]->boundingRadius(), pair.convex[1]->boundingRadius());
		}
		bool isInternal(int plane) const
		{
			const int* const first = internal.plane[piece];
			return std::find(first, first + internal.count[piece], plane) != first + internal.count[piece];
		}
		bool onFace() const
		{
			const Real flat = 1 - Real(polytope::tolerance::parallel);
			return std::any_of(
			        own.begin(), own.end(), [&](const polytope::Plane& plane) { return plane.normal.dot(up) > flat; });
		}
		/// From a point down to the other body's surface.
		Real depthAt(const Vector3r& point) const
		{
			Real way = std::numeric_limits<Real>::infinity();
			for (const polytope::Plane& plane : mover) {
				const Real cosine = -plane.normal.dot(up);
				if (cosine > 0) way = math::min(way, Real((plane.offset - plane.normal.dot(point)) / cosine));
			}
			return math::isfinite(way) ? way : Real(0);
		}
		/// Calls visit(solid) for the other pieces, of facets with their prisms in the mesh if `mitred`.
		template <class Visit> void forOthers(bool mitred, const Visit& visit) const
		{
			static thread_local Solid solid;
			forOtherPieces(pair, 1 - piece, [&](const Body& other, const Vector3r& at, const Vector3r& shift) {
				if (mitred) setMitred(solid, other, at, moving(), centre(), shift, reach(), *pair.scene);
				else setBody(solid, other, at, centre(), reach());
				visit(solid);
			});
		}
	};

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
		Vector3r nearest() const
		{
			return at(math::max(first, math::min(last, Real(-from.dot(direction) / direction.squaredNorm()))));
		}
	};

	/// A place of a piece that lies in the other body, on an edge or a vertex.
	struct Ridge {
		Vector3r point;          ///< from the contact point
		Real     depth  = 0;     ///< of the other body's surface below it; 0: there is none
		bool     shared = false; ///< another piece has it too
		bool     hollow = false; ///< and rises there
	};

	/// Places on the edges nearest to the contact point, and vertices at which all edges end that begin there: tips, not ends of a ridge. Edges go on over
	/// internal faces, beyond which another piece continues them.
	std::vector<Ridge> edgesAndTips(const OnPiece& on)
	{
		const auto&        surface = on.pair.convex[on.piece]->polyhedron();
		std::vector<Ridge> found, tips;
		for (const Vector3r& vertex : surface.vertices) {
			const Vector3r corner = on.pair.centre[on.piece] - on.pair.point + on.pair.rotation[on.piece] * vertex;
			tips.push_back({ corner, contains(on.mover, corner) ? on.depthAt(corner) : Real(0) });
		}
		// an edge from a tip leaves the other body through what is below, not at its side
		const auto staysIn = [&](Ridge& tip, const Vector3r& end) {
			if (on.depthAt(end) > Real(polytope::tolerance::besideSeam) * tip.depth) tip.depth = 0;
		};
		for (const auto& face : surface.faces)
			for (std::size_t k = 0; k < face.size(); ++k) {
				const int one = face[k], two = face[(k + 1) % face.size()];
				if (one > two) continue; // of the face beyond it
				Ridge & from = tips[std::size_t(one)], &to = tips[std::size_t(two)];
				Stretch edge { from.point, to.point - from.point };
				for (const polytope::Plane& plane : on.mover)
					edge.cut(plane, 0);
				if (from.depth > 0) staysIn(from, edge.at(math::min(edge.last, Real(1))));
				if (to.depth > 0) staysIn(to, edge.at(math::max(edge.first, Real(0))));
				for (std::size_t i = 0; i < on.own.size() && edge.any(); ++i)
					if (!on.isInternal(int(i))) edge.cut(on.own[i], on.rest());
				if (edge.any()) found.push_back({ edge.nearest(), on.depthAt(edge.nearest()) });
			}
		found.insert(found.end(), tips.begin(), tips.end());
		return found;
	}

	/// Where an edge or a vertex that the piece has in common with others lies deepest in the other body: a ridge or a tip that is made of pieces.
	Ridge deepestRidge(const OnPiece& on)
	{
		std::vector<Ridge> ridges = edgesAndTips(on);
		ridges.erase(std::remove_if(ridges.begin(), ridges.end(), [](const Ridge& one) { return !(one.depth > 0); }), ridges.end());
		if (ridges.empty()) return {};
		// in a valley the other piece rises beyond the edge: there the body lies on two faces, with two springs
		const auto rises = [&](const Solid& other, const Vector3r& point) {
			const Vector3r away = point - on.up.dot(point) * on.up;
			const Real     far  = away.norm();
			return far > 0
			        && contains(
			                other.planes, point + on.beside() * (away / far + Real(polytope::tolerance::besideSeam) * on.up));
		};
		on.forOthers(true, [&](const Solid& other) {
			for (Ridge& one : ridges)
				if (contains(other.planes, one.point, on.beside()))
					(rises(other, one.point) ? one.hollow : one.shared) = true;
		});
		Ridge deepest;
		for (const Ridge& one : ridges)
			if (one.shared && !one.hollow && one.depth > deepest.depth) deepest = one;
		return deepest;
	}

	/// Areas in which a plane through a place cuts the other body and each piece.
	class Areas {
	public:
		Areas(const OnPiece& on, const Vector3r& place) : on_(on), planes_(on.mover), place_(place)
		{
			for (polytope::Plane& plane : planes_)
				plane.offset -= plane.normal.dot(place_);
		}
		Real of(const Planes& solid)
		{
			if (solid.empty()) return 0;
			const std::size_t covered = planes_.size();
			for (const polytope::Plane& plane : solid)
				planes_.push_back({ plane.normal, plane.offset - plane.normal.dot(place_) });
			const Real area
			        = polytope::sectionArea(planes_, on_.pair.normal, on_.reach(), on_.pair.convex[1 - on_.piece]->dimension());
			planes_.erase(planes_.begin() + std::ptrdiff_t(covered), planes_.end());
			return area;
		}

	private:
		const OnPiece& on_;
		Planes         planes_;
		Vector3r       place_;
	};

	/// The pieces that carry the other body together with this one: those that continue its face, and, on a ridge, those that have it too or continue a face of one that has.
	std::vector<Solid> carryingTogether(const OnPiece& on, const Ridge& ridge)
	{
		const bool         onRidge = ridge.depth > 0;
		const Real         step    = flushStep(on.pair);
		std::vector<Solid> found(1), rest;
		setBody(found[0], bodyOf(on.pair, on.piece), on.pair.centre[on.piece] - on.pair.point, on.centre(), on.reach());
		if (onRidge) found[0].planes = on.own; // a facet's as the contact has it
		on.forOthers(onRidge, [&](const Solid& other) { rest.push_back(other); });
		for (std::size_t known = 0; known < found.size() && (known == 0 || onRidge);) {
			known              = found.size();
			const auto belongs = [&](const Solid& solid) {
				if (onRidge && contains(solid.planes, ridge.point, on.beside())) return true;
				for (std::size_t k = 0; k < known; ++k)
					if (haveCommonFace(found[k], solid, on.up, step)) return true;
				return false;
			};
			const auto others = std::stable_partition(rest.begin(), rest.end(), belongs);
			found.insert(found.end(), rest.begin(), others);
			rest.erase(rest.begin(), others);
		}
		return found;
	}

} // namespace

SupportShare shareOfSupport(const TouchingPair& pair, const polytope::InternalPlanes& internal)
{
	for (int piece = 0; piece < 2; ++piece) {
		if (!isPiece(bodyOf(pair, piece))) continue;
		OnPiece    on(pair, internal, piece);
		const bool onFace = on.onFace();
		if (onFace && internal.count[piece] == 0) continue;
		on.mover          = on.planesOf(1 - piece);
		const Ridge ridge = onFace ? Ridge() : deepestRidge(on);
		if (internal.count[piece] == 0 && !(ridge.depth > 0)) continue;

		Areas areas(on, ridge.depth > 0 ? Vector3r(ridge.point - ridge.depth / 2 * on.up) : Vector3r(Vector3r::Zero()));
		const std::vector<Solid> carrying = carryingTogether(on, ridge);
		Real                     here = 0, all = 0;
		for (const Solid& solid : carrying) {
			const Real area = areas.of(solid.planes);
			if (&solid == &carrying.front()) here = area;
			all += area;
		}
		if (!(all > 0)) continue;
		return { math::max(Real(here / all), Real(polytope::tolerance::leastShareOfSupport)), ridge.depth };
	}
	return {};
}

} // namespace yade
