// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <src/contact/ContactQuery.hpp>
#include <src/shape/PlacedShape.hpp>

#include "host/Partners.hpp"
#include "host/PartsOfBodies.hpp"
#include "shape/ShapeFamily.hpp"

#include <utility>
#include <vector>

/// The pieces of a rigid support, on several of which a body may lie, as half-spaces around a contact.
///
/// All of it follows from poses and shapes, not from other contacts' geometry, which other threads may be writing.
namespace yade {

/// One contact as both bodies stand: half-spaces of `convex` in axes `rotation` about `centre`, body 2 moved by its period.
struct TouchingPair {
	const Interaction*           contact;
	Scene*                       scene;
	const polytope::ConvexShape* convex[2];
	Vector3r                     centre[2];
	Matrix3r                     rotation[2];
	Vector3r                     point;                     ///< in the overlap
	Real                         ball;                      ///< radius of the largest ball in the overlap
	Vector3r                     nearer = Vector3r::Zero(); ///< by which body 2, and what moves as one with it, counts as moved
};

inline const Body& bodyOf(const TouchingPair& pair, int which)
{
	return *Body::byId(which == 0 ? pair.contact->getId1() : pair.contact->getId2(), pair.scene);
}

/// Which of the bodies (0, 1) is the support of a shape with a margin where both are pieces (MarginOnPieces.hpp): the fixed one, else the one with the lower
/// number.
int supportOf(const TouchingPair& pair);

/// Half-spaces of a body whose centre is at `centre` from the contact point, as a body whose centre is at `other` meets it. None for
/// shapes without faces, and for bodies farther than `near` from the contact point.
void setBody(Solid& solid, const Body& body, const Vector3r& centre, const Vector3r& other, Real near);

/// Whether a point lies in all half-spaces, of which there are some, or not farther than `room` out of each.
bool contains(const Planes& planes, const Vector3r& point, const Real& room = 0);

/// The solid's face along a normal that passes within `step` of a point, along that face's normal; null: it has none. Where the point is on a face of
/// another piece, that face goes on here.
const polytope::Plane* faceAt(const Solid& solid, const Vector3r& outward, const Vector3r& point, Real step);

/// What rounding of poses leaves between pieces that lie flush; a wall has no size.
Real roundingOf(const TouchingPair& pair);

/// How high a step between two faces is that count as one.
Real flushStep(const TouchingPair& pair);

/// Less than two images of a body are apart.
Real imagesApart(const Scene& scene);

/// Calls visit(neighbour, its centre from the contact point) for the other pieces of the rigid support that body `mover` of the pair, or what moves as
/// one with it, may touch: the members of its clump, and of what is fixed what is in the lists of pairs of the mover and of the parts of its clump.
template <class Visit> void forOtherPieces(const TouchingPair& pair, int mover, const Visit& visit)
{
	const Body &   body = bodyOf(pair, mover), &own = bodyOf(pair, 1 - mover);
	const Vector3r centre = pair.centre[mover] - pair.point, ofOwn = pair.centre[1 - mover] - pair.point;
	const Real     same = imagesApart(*pair.scene);

	std::vector<std::pair<Body::id_t, Vector3r>> seen;

	const auto visitNew = [&](const Body& piece, const Vector3r& place) {
		for (const auto& one : seen)
			if (one.first == piece.id && (one.second - place).norm() < same) return;
		seen.emplace_back(piece.id, place);
		visit(piece, place);
	};
	if (own.isClumpMember())
		forParts(moverOf(own, *pair.scene), *pair.scene, [&](const Body& piece) {
			if (piece.id == own.id || !piece.shape || !piece.maskOk(body.groupMask)) return;
			visitNew(piece, ofOwn + piece.state->pos - own.state->pos);
		});
	if (!isFixed(own, *pair.scene)) return;
	forParts(moverOf(body, *pair.scene), *pair.scene, [&](const Body& part) {
		forPartners(part, own.id, *pair.scene, [&](const Body& piece, const Vector3r& shift) {
			if (rigidTogether(piece, own, *pair.scene) && !inOneClump(piece, body))
				visitNew(piece, centre + piece.state->pos - body.state->pos + shift);
		});
	});
}

} // namespace yade
