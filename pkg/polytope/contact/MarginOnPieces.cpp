// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MarginOnPieces.hpp"

#include <src/contact/PairDistance.hpp>
#include <src/contact/RoundedSection.hpp>
#include <src/numbers/Tolerances.hpp>
#include <src/shear/ContactOutline.hpp>

#include <algorithm>

namespace yade {

MarginOnPieces::MarginOnPieces(const TouchingPair& pair, int mover, const CoreOfBody& core) : margin_(core.margin), reach_(core.margin)
{
	if (core.convex)
		for (const Vector3r& vertex : core.convex->polyhedron().vertices)
			core_.push_back(core.rotation * vertex);
	else core_ = { Vector3r::Zero(), core.way };
	for (const Vector3r& point : core_)
		reach_ = math::max(reach_, Real(point.norm() + margin_));
	thin_ = Real(polytope::tolerance::thinContact) * (core.convex ? core.convex->inscribedRadius() : margin_);

	const Vector3r ofMover = pair.centre[mover] - pair.point;
	if (!add(bodyOf(pair, 1 - mover), pair.centre[1 - mover] - pair.point, ofMover)) return;
	forOtherPieces(pair, mover, [&](const Body& piece, const Vector3r& centre) { add(piece, centre, ofMover); });
}

bool MarginOnPieces::add(const Body& body, const Vector3r& centre, const Vector3r& ofMover)
{
	if (!body.shape) return false;
	const ShapeFamily& family = familyOf(*body.shape);
	const auto         core   = family.core(*body.shape, centre, body.state->ori, ofMover);
	if (core && (core->margin > 0 || !core->convex)) return false;
	Piece piece;
	setBody(piece.solid, body, centre, ofMover, reach_);
	if (piece.solid.planes.empty()) return false;
	if (const auto surface = family.surface(*body.shape)) piece.corners = surface->vertices;
	for (Vector3r& corner : piece.corners)
		corner = centre + body.state->ori * corner;
	pieces_.push_back(std::move(piece));
	return true;
}

Real MarginOnPieces::flushRoom() const { return Real(polytope::tolerance::flush) * reach_; }

/// The core's point that is farthest against a direction.
Vector3r MarginOnPieces::lowest(const Vector3r& outward) const
{
	return *std::min_element(
	        core_.begin(), core_.end(), [&](const Vector3r& a, const Vector3r& b) { return outward.dot(a) < outward.dot(b); });
}

/// None where the core itself overlaps the piece.
std::optional<SupportPlace> MarginOnPieces::placeOn(const Piece& piece) const
{
	if (piece.corners.empty()) {
		const polytope::Plane& plane = piece.solid.planes.front();
		const Vector3r         low   = lowest(plane.normal);
		const Real             gap   = plane.normal.dot(low) - plane.offset;
		if (!(gap > 0)) return std::nullopt;
		return SupportPlace { plane.normal, low - gap * plane.normal, margin_ - gap };
	}
	const auto way = polytope::pairDistance(piece.corners, core_);
	if (!(way.distance > 0)) return std::nullopt;
	return SupportPlace { way.normal, way.point[0], margin_ - way.distance };
}

/// Where the core itself overlaps pieces: out through a face of this one that others continue and none covers at `point`, the nearest, if
/// the core slides on it.
std::optional<SupportPlace> MarginOnPieces::placeOnFace(const Vector3r& point, Real room) const
{
	std::optional<SupportPlace> best;
	const Solid&                own = pieces_.front().solid;
	for (std::size_t k = 0; k < own.faces; ++k) {
		const polytope::Plane& face  = own.planes[k];
		const Vector3r         low   = lowest(face.normal);
		const Real             under = face.offset - face.normal.dot(low);
		const SupportPlace     place { face.normal, low + under * face.normal, margin_ + under };
		if (!(under < thin_) || (best && best->depth <= place.depth)) continue;
		const auto continues = [&](const Piece& piece) {
			return &piece != &pieces_.front()
			        && faceAt(piece.solid, place.outward, place.point, math::max(Real(place.depth / 2), room));
		};
		const auto holds
		        = [&](const Piece& piece) { return contains(piece.solid.planes, place.point, math::max(place.depth, room)); };
		const Vector3r outside = point + (face.offset - face.normal.dot(point) + 2 * room) * face.normal;
		const auto     covers  = [&](const Piece& piece) { return contains(piece.solid.planes, outside, room); };
		const auto     any     = [&](const auto& is) { return std::any_of(pieces_.begin(), pieces_.end(), is); };
		if (any(continues) && any(holds) && !any(covers)) best = place;
	}
	return best;
}

void MarginOnPieces::toNearest(SupportPlace& place) const
{
	bool overlaps = place.depth > margin_;
	for (bool nearer = true; nearer;) { // each time to a piece that is nearer
		nearer                     = false;
		const SupportPlace present = place;
		const Real         room    = math::max(present.depth, flushRoom());
		for (std::size_t k = 1; k < pieces_.size(); ++k) {
			if (!contains(pieces_[k].solid.planes, present.point, room)) continue;
			const auto other = placeOn(pieces_[k]);
			if (!other) overlaps = true;
			else if (other->depth > place.depth) {
				place  = *other;
				nearer = true;
			}
		}
	}
	if (!overlaps) return;
	if (const auto onFace = placeOnFace(place.point, flushRoom())) place = *onFace;
}

std::vector<polytope::FaceCorners> MarginOnPieces::faces(const SupportPlace& place) const
{
	std::vector<polytope::FaceCorners> all;
	const polytope::PlaneAxes          axes(place.outward);
	const Real                         step = math::max(Real(place.depth / 2), flushRoom()), far = 2 * reach_;
	for (const Piece& piece : pieces_) {
		const polytope::Plane* const face = faceAt(piece.solid, place.outward, place.point, step);
		if (!face && all.empty()) return {};
		if (!face) continue;
		polytope::PlanePolygon corners { { -far, -far }, { far, -far }, { far, far }, { -far, far } };
		for (const polytope::Plane& plane : piece.solid.planes)
			if (&plane != face) clipByPlane(corners, plane, axes, place.point);
		all.emplace_back();
		for (const auto& corner : corners)
			all.back().push_back(place.point + axes.inSpace(corner));
	}
	return all;
}

MarginOnPieces::Share MarginOnPieces::share(const SupportPlace& place) const
{
	const polytope::PlaneAxes    axes(place.outward);
	const Vector3r               at      = place.point - place.depth / 2 * place.outward;
	const polytope::PlanePolygon section = roundedSection(core_, margin_, place.outward, axes, at);
	Real                         own = 0, all = 0;
	polytope::Vector2            middle = polytope::Vector2::Zero(), ofAll = polytope::Vector2::Zero();
	for (const Piece& piece : pieces_) {
		polytope::PlanePolygon part = section;
		for (const polytope::Plane& plane : piece.solid.planes)
			clipByPlane(part, plane, axes, at);
		const auto moments = polytope::momentsOf(part.data(), int(part.size()));
		if (&piece == &pieces_.front()) {
			own    = moments.area;
			middle = moments.centroid;
		}
		all += moments.area;
		ofAll += moments.area * moments.centroid;
	}
	if (!(all > 0)) return { 1, Vector3r::Zero() };
	if (!(own > 0)) return { polytope::tolerance::leastShareOfSupport, Vector3r::Zero() };
	return { math::max(Real(own / all), Real(polytope::tolerance::leastShareOfSupport)), axes.inSpace(middle - ofAll / all) };
}

} // namespace yade
