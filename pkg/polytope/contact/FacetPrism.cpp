// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/FacetPrism.hpp"

#include "host/Partners.hpp"

#include <lib/high-precision/Constants.hpp>

#include <algorithm>

namespace yade {

namespace {

	/// A thread's own; it grows to the most facets that a body has had near it.
	template <class Facets> Facets& emptyOfThread()
	{
		static thread_local Facets facets;
		facets.clear();
		return facets;
	}

} // namespace

FacetInMesh::FacetInMesh(const Body& facet, const Body& body2, const Vector3r& shift2, Scene& scene)
        : mesh_(emptyOfThread<std::vector<OfMesh>>())
{
	const auto& shape = static_cast<const Facet&>(*facet.shape);
	mesh_.push_back({ { shape.vertices[0], shape.vertices[1], shape.vertices[2] }, { 0, 1, 2 } });
	normal_ = normalOfTriangle([this](int k) -> const Vector3r& { return corner(k); });
	size_   = 0;
	for (int k = 0; k < 3; ++k)
		size_ = math::max(size_, (corner((k + 1) % 3) - corner(k)).norm());
	const Real near  = Real(pieces::sameCorner) * size_;
	const auto toOwn = facet.state->ori.conjugate();
	forPartners(body2, facet.id, scene, [&](const Body& partner, const Vector3r& shift) {
		const auto* beside = dynamic_cast<const Facet*>(partner.shape.get());
		if (!beside) return;
		const Vector3r centre = partner.state->pos - facet.state->pos + (shift + shift2);
		OfMesh         other;
		int            shared = 0;
		for (int k = 0; k < 3; ++k) {
			other.corner[k] = toOwn * Vector3r(centre + partner.state->ori * beside->vertices[k]);
			other.own[k]    = -1;
			for (int own = 0; own < 3; ++own)
				if ((other.corner[k] - corner(own)).squaredNorm() <= near * near) other.own[k] = own;
			shared += other.own[k] >= 0;
		}
		if (shared == 3) return;
		mesh_.push_back(other);
		if (shared == 2) addTilt(other);
	});
}

/// Direction in the facet's plane that is normal to edge k and points away from the facet.
Vector3r FacetInMesh::outward(int k) const
{
	return outwardOfEdge([this](int i) -> const Vector3r& { return corner(i); }, normal_, k);
}

void FacetInMesh::addTilt(const OfMesh& other)
{
	const int      apex = other.own[0] < 0 ? 0 : other.own[1] < 0 ? 1 : 2;
	const int      one = other.own[(apex + 1) % 3], two = other.own[(apex + 2) % 3];
	const int      k  = (one + 1) % 3 == two ? one : two; // edge k runs from corner k to the next
	const Vector3r to = other.corner[apex] - corner(k);
	using std::atan2;
	const Real tilt = atan2(normal_.dot(to), outward(k).dot(to));
	lowest_[k]      = known_[k] ? math::min(lowest_[k], tilt) : tilt;
	highest_[k]     = known_[k] ? math::max(highest_[k], tilt) : tilt;
	known_[k]       = true;
}

/// The facet of the mesh beyond an edge of another one, of several the one that rises most to the side `turn` of that one's normal.
FacetInMesh::Beyond FacetInMesh::beyond(std::size_t facet, int edge, int turn) const
{
	const Vector3r* const own    = mesh_[facet].corner;
	const Real            near   = Real(pieces::sameCorner) * size_;
	const auto            at     = [&](int k) -> const Vector3r& { return own[k]; };
	const Vector3r        normal = turn * normalOfTriangle(at), out = outwardOfEdge(at, Vector3r(turn * normal), edge);
	const auto            isCorner = [&](const Vector3r& one, int k) { return (one - at(k % 3)).squaredNorm() <= near * near; };
	Beyond                found { mesh_.size(), turn, 0 };
	for (std::size_t other = 0; other < mesh_.size(); ++other)
		for (int k = 0; k < 3 && other != facet; ++k) {
			const Vector3r &one = mesh_[other].corner[k], &two = mesh_[other].corner[(k + 1) % 3];
			const bool      against = isCorner(one, edge + 1) && isCorner(two, edge),
			           along        = isCorner(one, edge) && isCorner(two, edge + 1);
			if (!against && !along) continue;
			const Vector3r to = mesh_[other].corner[(k + 2) % 3] - at(edge);
			using std::atan2;
			const Real tilt = atan2(normal.dot(to), out.dot(to));
			if (found.facet == mesh_.size() || tilt > found.tilt) found = { other, against ? turn : -turn, tilt };
		}
	return found;
}

/// Goes over the mesh towards the point, from facet to facet, until it is beside one, or at the edge between two.
int FacetInMesh::sideOf(const Vector3r& point) const
{
	std::size_t facet = 0, last = mesh_.size();
	int         turn = 1;
	for (std::size_t hop = 0;; ++hop) {
		const auto     at       = [&](int k) -> const Vector3r& { return mesh_[facet].corner[k]; };
		const Vector3r normal   = normalOfTriangle(at);
		int            farthest = -1;
		Real           way      = 0;
		for (int k = 0; k < 3; ++k) {
			const Real out = outwardOfEdge(at, normal, k).dot(point - at(k));
			if (out > way) {
				way      = out;
				farthest = k;
			}
		}
		const Real   above = turn * normal.dot(point - at(0));
		const Beyond next  = farthest < 0 ? Beyond { mesh_.size(), turn, 0 } : beyond(facet, farthest, turn);
		if (next.facet == mesh_.size()) return above < 0 ? -1 : 1;
		using std::atan2;
		if (next.facet == last || hop == mesh_.size()) return atan2(above, way) < next.tilt ? -1 : 1;
		last  = facet;
		facet = next.facet;
		turn  = next.turn;
	}
}

void FacetInMesh::Prism::add(const Vector3r& normal, const Vector3r& point) { planes[size_t(count++)] = { normal, normal.dot(point) }; }

bool FacetInMesh::Prism::made(const polytope::ConvexShape& solid) const
{
	if (solid.planeCount() != count) return false;
	const Real rest = Real(pieces::samePlane);
	for (int i = 0; i < count; ++i) {
		const Vector3r& normal = solid.planes().normals[size_t(i)];
		const Real&     offset = solid.planes().offsets[size_t(i)];
		const auto&     plane  = planes[size_t(i)];
		if (normal == plane.normal && offset == plane.offset) continue;
		if (i < 2) return false; // front and back follow from the facet's own corners alone
		if ((normal - plane.normal).squaredNorm() > rest * rest) return false;
		if (math::abs(offset - plane.offset) > rest * solid.boundingRadius()) return false;
	}
	return true;
}

FacetInMesh::Prism FacetInMesh::prism(int side, const Real& depth) const
{
	const Vector3r up = side * normal_;
	Prism          prism;
	prism.add(up, corner(0));
	prism.planes[1] = { -up, depth - up.dot(corner(0)) };
	prism.count     = 2;
	for (int k = 0; k < 3; ++k) {
		const Vector3r out   = outward(k);
		const Real     tilt  = !known_[k] ? Real(0) : side > 0 ? highest_[k] : Real(-lowest_[k]);
		const Real     solid = tilt + Mathr::PI;
		const bool     bent  = math::abs(tilt) > pieces::samePlane && solid > pieces::sharpestEdge && solid < pieces::widestEdge;
		prism.add(bent ? Vector3r((math::cos(tilt / 2) * out + math::sin(tilt / 2) * up).normalized()) : out, corner(k));
	}
	for (int k = 0; k < 3; ++k)
		addCutsAt(k, up, prism);
	return prism;
}

/// If all facets at the corner lie below each other's planes: half-way planes against those that share no edge there.
void FacetInMesh::addCutsAt(int at, const Vector3r& up, Prism& prism) const
{
	const Vector3r& tip  = corner(at);
	const Real      rest = Real(pieces::sameCorner) * size_;
	const int       none = prism.count;
	for (std::size_t number = 1; number < mesh_.size(); ++number) {
		const OfMesh& other = mesh_[number];
		if (std::find(other.own.begin(), other.own.end(), at) == other.own.end()) continue;
		Vector3r normal = normalOfTriangle([&other](int i) -> const Vector3r& { return other.corner[i]; });
		Real     low = 0, high = 0, above = 0;
		for (int k = 0; k < 3; ++k) {
			const Real height = normal.dot(corner(k) - tip);
			low               = math::min(low, height);
			high              = math::max(high, height);
			above             = math::max(above, up.dot(other.corner[k] - tip));
		}
		if (high > -low) {
			normal = -normal;
			std::swap(low, high);
			high = -high;
		}
		if (math::abs(low) <= rest && normal.dot(up) < 0) normal = -normal;
		if (above > rest || high > rest) { // hollow
			prism.count = none;
			return;
		}
		const Vector3r apart     = normal - up;
		const bool     sharesAll = std::count(other.own.begin(), other.own.end(), -1) == 1; // an edge: its side is mitred
		if (!sharesAll && apart.norm() > rest / size_ && prism.count < int(prism.planes.size())) prism.add(apart.normalized(), tip);
	}
}

void setGround(const Body& facet, const Vector3r& centre, const Body& body2, const Vector3r& other, Scene& scene, Solid& solid)
{
	const FacetInMesh        mesh(facet, body2, Vector3r(other - centre - (body2.state->pos - facet.state->pos)), scene);
	const Quaternionr&       turn  = facet.state->ori;
	const FacetInMesh::Prism prism = mesh.prism(mesh.sideOf(turn.conjugate() * Vector3r(other - centre)), 0);
	solid.clear();
	for (int k = 0; k < prism.count; ++k) {
		if (k == FacetInMesh::Prism::back) continue;
		const Vector3r normal = turn * prism.planes[std::size_t(k)].normal;
		solid.planes.push_back({ normal, prism.planes[std::size_t(k)].offset + normal.dot(centre) });
	}
	solid.faces = 1;
}

} // namespace yade
