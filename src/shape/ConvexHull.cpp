// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ConvexHull.hpp"

#include "shape/CgalGeometry.hpp"
#include "shape/ConstructionTolerances.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace polytope {
namespace {

	/// Six times the volume of the tetrahedron (a, b, c, p), positive where p lies on the side from which a, b, c run
	/// counter-clockwise; `certain`: its sign is that of the exact value. (Shewchuk 1997, "Adaptive precision floating-point
	/// arithmetic and fast robust geometric predicates", Discrete Comput. Geom. 18:305-363.)
	Real height(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p, bool& certain)
	{
		const Real ax = a.x() - p.x(), ay = a.y() - p.y(), az = a.z() - p.z();
		const Real bx = b.x() - p.x(), by = b.y() - p.y(), bz = b.z() - p.z();
		const Real cx = c.x() - p.x(), cy = c.y() - p.y(), cz = c.z() - p.z();
		const Real bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
		const Real value = az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay);
		const Real spread
		        = abs(az) * (abs(bxcy) + abs(cxby)) + abs(bz) * (abs(cxay) + abs(axcy)) + abs(cz) * (abs(axby) + abs(bxay));
		certain = abs(value) > construction::volumeRounding * spread + construction::volumeUnderflow;
		return -value;
	}

	/// Facets, the points above each in a chained list.
	class Quickhull {
	public:
		explicit Quickhull(const std::vector<Vector3>& points)
		        : points_(points), next_(points.size(), -1), facetFrom_(points.size(), -1)
		{
			facets_.reserve(4 * points.size());
			startWith(spanningTetrahedron());
			while (!open_.empty()) {
				const int f = open_.back();
				open_.pop_back();
				if (facets_[std::size_t(f)].alive && facets_[std::size_t(f)].first >= 0) raise(f);
			}
		}

		Triangles triangles() const
		{
			Triangles result;
			for (const Facet& facet : facets_) {
				if (!facet.alive) continue;
				result.push_back(facet.corner);
				Triangle& t = result.back();
				std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
			}
			std::sort(result.begin(), result.end());
			return result;
		}

	private:
		struct Facet {
			Triangle corner;
			Triangle beside;                ///< [k]: the facet beyond the edge from corner k to the next
			int      first = -1, last = -1; ///< points above it, in the order of `next_`
			int      farthest = -1;
			Real     most     = 0;
			bool     alive = true, visible = false;
		};
		/// An edge of the part that is visible from a point, in the direction of the visible facet.
		struct Rim {
			int from, to, outside;
		};

		const std::vector<Vector3>& points_;
		std::vector<Facet>          facets_;
		std::vector<int>            next_, facetFrom_, open_, seen_;
		std::vector<Rim>            rim_;

		const Vector3& at(int i) const { return points_[std::size_t(i)]; }

		/// Height of point p above the plane of the triangle's corners: positive only if the exact one is.
		Real above(const Triangle& t, int p) const
		{
			bool       certain = false;
			const Real value   = height(at(t[0]), at(t[1]), at(t[2]), at(p), certain);
			if (certain) return value;
			const int sign = exact::orientation(at(t[0]), at(t[1]), at(t[2]), at(p));
			// the size only ranks points
			return sign <= 0 ? Real(sign) : std::max(value, std::numeric_limits<Real>::min());
		}

		std::array<int, 4> spanningTetrahedron() const
		{
			std::array<int, 4> corner { { 0, 0, 0, 0 } };
			const int          count    = int(points_.size());
			const auto         farthest = [&](const auto& measure) {
                                int  best = 0;
                                Real most = -1;
                                for (int i = 0; i < count; ++i) {
                                        const Real m = measure(i);
                                        if (m > most) {
                                                most = m;
                                                best = i;
                                        }
                                }
                                return best;
			};
			for (int i = 1; i < count; ++i)
				if (at(i).x() < at(corner[0]).x()) corner[0] = i;
			const Vector3 a = at(corner[0]);
			corner[1]       = farthest([&](int i) { return (at(i) - a).squaredNorm(); });
			const Vector3 b = at(corner[1]) - a;
			corner[2]       = farthest([&](int i) { return b.cross(at(i) - a).squaredNorm(); });
			const Vector3 n = b.cross(at(corner[2]) - a);
			corner[3]       = farthest([&](int i) { return abs(n.dot(at(i) - a)); });
			if (exact::orientation(a, at(corner[1]), at(corner[2]), at(corner[3])) != 0) return corner;
			for (int i = 0; i < count; ++i) // rounding gave no four points that span space
				for (int j = 0; j < i; ++j)
					if (exact::orientation(a, at(corner[1]), at(i), at(j)) != 0)
						return { { corner[0], corner[1], i, j } };
			throw std::logic_error("hullTriangles: the points lie in a plane");
		}

		void startWith(std::array<int, 4> c)
		{
			if (exact::orientation(at(c[0]), at(c[1]), at(c[2]), at(c[3])) > 0) std::swap(c[0], c[1]);
			// c[3] is below (c0, c1, c2) as seen from outside
			facets_.resize(4);
			facets_[0].corner = { { c[0], c[1], c[2] } };
			facets_[0].beside = { { 1, 2, 3 } };
			for (int k = 0; k < 3; ++k) {
				Facet& facet = facets_[std::size_t(k + 1)];
				facet.corner = { { c[std::size_t((k + 1) % 3)], c[std::size_t(k)], c[3] } };
				facet.beside = { { 0, (k + 2) % 3 + 1, (k + 1) % 3 + 1 } };
			}
			for (int i = 0; i < int(points_.size()); ++i)
				if (std::find(c.begin(), c.end(), i) == c.end()) assign(i, 0);
			for (int f = 0; f < 4; ++f)
				if (facets_[std::size_t(f)].first >= 0) open_.push_back(f);
		}

		/// Puts a point into the list of the first facet from `begin` on that it is above; none: it is inside.
		void assign(int p, std::size_t begin)
		{
			for (std::size_t f = begin; f < facets_.size(); ++f) {
				Facet&     facet = facets_[f];
				const Real most  = above(facet.corner, p);
				if (!(most > 0)) continue;
				(facet.first < 0 ? facet.first : next_[std::size_t(facet.last)]) = p;
				facet.last                                                       = p;
				next_[std::size_t(p)]                                            = -1;
				if (most > facet.most) {
					facet.most     = most;
					facet.farthest = p;
				}
				return;
			}
		}

		/// Adds the farthest point above a facet to the hull. The facets visible from it are replaced by a cone of new ones.
		void raise(int from)
		{
			const int apex = facets_[std::size_t(from)].farthest;
			look(from, apex);
			const std::size_t begin = facets_.size();
			for (const Rim& edge : rim_) {
				Facet facet;
				facet.corner                       = { { edge.from, edge.to, apex } };
				facet.beside                       = { { edge.outside, -1, -1 } };
				facetFrom_[std::size_t(edge.from)] = int(facets_.size());
				Facet& outside                     = facets_[std::size_t(edge.outside)];
				for (std::size_t k = 0; k < 3; ++k)
					if (outside.corner[k] == edge.to && outside.corner[(k + 1) % 3] == edge.from)
						outside.beside[k] = int(facets_.size());
				facets_.push_back(facet);
			}
			for (std::size_t f = begin; f < facets_.size(); ++f) {
				const int following                       = facetFrom_[std::size_t(facets_[f].corner[1])];
				facets_[f].beside[1]                      = following;
				facets_[std::size_t(following)].beside[2] = int(f);
			}
			for (int f : seen_)
				for (int p = facets_[std::size_t(f)].first; p >= 0;) {
					const int following = next_[std::size_t(p)];
					if (p != apex) assign(p, begin);
					p = following;
				}
			for (std::size_t f = begin; f < facets_.size(); ++f)
				if (facets_[f].first >= 0) open_.push_back(int(f));
		}

		/// The facets visible from a point, and the boundary (horizon) of the visible part.
		void look(int from, int apex)
		{
			seen_.assign(1, from);
			rim_.clear();
			facets_[std::size_t(from)].visible = true;
			for (std::size_t s = 0; s < seen_.size(); ++s) {
				const Facet& facet                   = facets_[std::size_t(seen_[s])];
				facets_[std::size_t(seen_[s])].alive = false;
				for (std::size_t k = 0; k < 3; ++k) {
					Facet& other = facets_[std::size_t(facet.beside[k])];
					if (other.visible) continue;
					if (above(other.corner, apex) > 0) {
						other.visible = true;
						seen_.push_back(facet.beside[k]);
					} else {
						rim_.push_back({ facet.corner[k], facet.corner[(k + 1) % 3], facet.beside[k] });
					}
				}
			}
		}
	};

} // namespace

Triangles hullTriangles(const std::vector<Vector3>& points) { return Quickhull(points).triangles(); }

} // namespace polytope
