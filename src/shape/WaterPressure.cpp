// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/WaterPressure.hpp"

#include "shape/DistanceTolerances.hpp"
#include "shape/Rings.hpp"

#include <algorithm>

namespace polytope {
namespace {

	/// Keeps the part of the polygon where value + slope·x ≥ 0.
	void keepWhere(const Real& value, const Vector3& slope, ClippedFace& face)
	{
		face.rest.clear();
		keepAbove(face.corners, [&](const Vector3& x) { return Real(value + slope.dot(x)); }, face.rest);
		face.corners.swap(face.rest);
	}

	/// Moves a piece into the body's frame and leaves out sides that do not cut the body. False where it gives the body no pressure.
	bool reaches(const PressurePiece& piece, const PlacedShape& body, PressurePiece& own)
	{
		const Real    radius = body.shape.boundingRadius();
		const Vector3 apart  = body.centre - piece.point;
		own.point            = Vector3::Zero();
		own.value            = piece.value + piece.gradient.dot(apart);
		own.gradient         = body.rotation.transpose() * piece.gradient;
		own.sideCount        = 0;
		const Real reach     = body.shape.dimension() == 2 ? radius + body.shape.thickness() : radius;
		if (own.value + piece.gradient.norm() * reach <= 0) return false;
		for (int k = 0; k < piece.sideCount; ++k) {
			const Real room = piece.sides[k].offset - piece.sides[k].normal.dot(apart);
			if (room <= -reach) return false;
			if (room < reach) own.sides[own.sideCount++] = { body.rotation.transpose() * piece.sides[k].normal, room };
		}
		return true;
	}

	/// Whether the whole face lies on a side, where two pieces meet.
	bool isOn(const PressurePiece::Side& side, const ClippedFace& face, const Real& room)
	{
		return std::all_of(face.corners.begin(), face.corners.end(),
		        [&](const Vector3& corner) { return abs(side.offset - side.normal.dot(corner)) <= room; });
	}

	/// Pressure of one piece on the polygon in `face`; all in the body's frame. A face where two pieces meet has the pressure of the one on
	/// the body's side.
	void addPressed(const PressurePiece& piece, const Vector3& outward, const Real& room, ClippedFace& face, WaterLoad& sum)
	{
		keepWhere(piece.value, piece.gradient, face);
		for (int k = 0; k < piece.sideCount; ++k) {
			const PressurePiece::Side& side = piece.sides[k];
			if (!isOn(side, face, room)) keepWhere(side.offset, -side.normal, face);
			else if (side.normal.dot(outward) < 0) return;
		}
		for (std::size_t k = 2; k < face.corners.size(); ++k) {
			const Vector3 &a = face.corners[0], &b = face.corners[k - 1], &c = face.corners[k];
			const Vector3  area = (b - a).cross(c - a) / 2;
			const Real     atA = piece.value + piece.gradient.dot(a), atB = piece.value + piece.gradient.dot(b),
			           atC = piece.value + piece.gradient.dot(c), all = atA + atB + atC;
			sum.force -= all / 3 * area;
			sum.torque -= (all * (a + b + c) + atA * a + atB * b + atC * c).cross(area) / 12;
		}
	}

} // namespace

void ClippedFace::holdFaceOf(std::size_t vertices)
{
	const std::size_t most = vertices + 1 + PressurePiece::mostSides; // a convex face gets one corner more by each cut
	corners.reserve(most);
	rest.reserve(most);
}

WaterLoad waterLoad(const PlacedShape& body, const std::vector<PressurePiece>& pieces, const std::vector<int>* wet, ClippedFace& memory)
{
	WaterLoad         sum;
	const Polyhedron& shape = body.shape.polyhedron();
	PressurePiece     own;
	const Real        room = tolerance::onSide * body.shape.boundingRadius();
	for (const PressurePiece& piece : pieces) {
		if (!reaches(piece, body, own)) continue;
		for (std::size_t face = 0; face < shape.faces.size(); ++face) {
			const int plane = shape.planeOfFace[face];
			if (plane < 0 || (wet && !std::binary_search(wet->begin(), wet->end(), plane))) continue;
			memory.corners.clear();
			for (const int vertex : shape.faces[face])
				memory.corners.push_back(shape.vertices[std::size_t(vertex)]);
			addPressed(own, body.shape.planes().normals[std::size_t(plane)], room, memory, sum);
		}
	}
	sum.force  = body.rotation * sum.force;
	sum.torque = body.rotation * sum.torque;
	return sum;
}

} // namespace polytope
