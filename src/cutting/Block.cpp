// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/Block.hpp"

#include "shape/InscribedBall.hpp"
#include "shape/PlaneMeeting.hpp"
#include "shape/ShapeConstruction.hpp"

#include <algorithm>
#include <stdexcept>

namespace polytope {
namespace {

	/// A point in which the plane cuts the edge between two corners, and the planes of the two faces at this edge.
	struct Crossing {
		int     low, high; ///< corners, ascending
		int     planes[2];
		Vector3 point;
	};

	/// One cut: on which side the corners are, and where edges are cut.
	struct Cut {
		const Block&              block;
		const std::vector<Plane>& all;
		const Plane&              plane;
		std::vector<Real>         heights; ///< of the corners above the plane
		std::vector<int>          sides;   ///< −1 below, 0 on it, 1 above
		std::vector<Crossing>     crossings;

		Cut(const Block& block, const std::vector<Plane>& all, const Plane& plane, const Real& on)
		        : block(block), all(all), plane(plane)
		{
			for (const Vector3& corner : block.corners) {
				heights.push_back(plane.normal.dot(corner) - plane.offset);
				sides.push_back(heights.back() > on ? 1 : heights.back() < -on ? -1 : 0);
			}
			for (std::size_t f = 0; f < block.faces(); ++f)
				for (int k = block.begin(f); k < block.end(f); ++k) {
					const int a = block.rings[std::size_t(k)], b = following(f, k);
					if (sides[std::size_t(a)] * sides[std::size_t(b)] < 0) note(a, b, block.planes[f]);
				}
			for (Crossing& crossing : crossings)
				place(crossing, on);
		}

		int following(std::size_t face, int k) const
		{
			return block.rings[std::size_t(k + 1 < block.end(face) ? k + 1 : block.begin(face))];
		}

		/// Index of the crossing of an edge that is cut, or −1 if it is new.
		int find(int a, int b) const
		{
			const int low = std::min(a, b), high = std::max(a, b);
			for (std::size_t i = 0; i < crossings.size(); ++i)
				if (crossings[i].low == low && crossings[i].high == high) return int(i);
			return -1;
		}

		void note(int a, int b, int face)
		{
			const int known = find(a, b);
			if (known >= 0) crossings[std::size_t(known)].planes[1] = face;
			else crossings.push_back({ std::min(a, b), std::max(a, b), { face, face }, Vector3::Zero() });
		}

		/// Places a crossing on the edge, and, where the three planes determine it accurately, on these: so errors do not add up.
		void place(Crossing& crossing, const Real& on) const
		{
			const std::size_t a = std::size_t(crossing.low), b = std::size_t(crossing.high);
			const Real        part = heights[a] / (heights[a] - heights[b]);
			crossing.point         = block.corners[a] + part * (block.corners[b] - block.corners[a]);
			const Plane &first = all[std::size_t(crossing.planes[0])], &second = all[std::size_t(crossing.planes[1])];
			Vector3      exact;
			if (meetingOfThree(
			            first.normal, second.normal, plane.normal, Vector3(first.offset, second.offset, plane.offset), exact)
			        && (exact - crossing.point).squaredNorm() <= on * on)
				crossing.point = exact;
		}
	};

	/// Edges of the faces that have no neighbour make the ring of the new face. Whether they are one closed ring.
	bool addNewFace(Block& part, const std::vector<bool>& onCut, int plane)
	{
		std::vector<std::pair<int, int>> edges; // in the new face's direction
		for (std::size_t f = 0; f < part.faces(); ++f)
			for (int k = part.begin(f); k < part.end(f); ++k) {
				const int a = part.rings[std::size_t(k)],
				          b = part.rings[std::size_t(k + 1 < part.end(f) ? k + 1 : part.begin(f))];
				if (!onCut[std::size_t(a)] || !onCut[std::size_t(b)]) continue;
				const auto other = std::find(edges.begin(), edges.end(), std::make_pair(a, b));
				if (other != edges.end()) edges.erase(other); // the neighbour has it
				else edges.push_back({ b, a });
			}
		if (edges.size() < 3) return false;
		const int first = edges.front().first;
		int       at    = first;
		for (std::size_t n = 0; n < edges.size(); ++n) {
			const auto edge = std::find_if(edges.begin(), edges.end(), [&](const auto& e) { return e.first == at; });
			if (edge == edges.end()) return false;
			part.rings.push_back(at);
			at          = edge->second;
			edge->first = -1;
		}
		part.closeFace(plane);
		return at == first && part.faces() >= 4;
	}

	/// The part on one side (−1: below the plane).
	bool takePart(const Cut& cut, int side, int plane, Block& part)
	{
		const Block&     block = cut.block;
		std::vector<int> number(block.corners.size(), -1);
		part = Block();
		std::vector<bool> onCut;
		for (std::size_t v = 0; v < block.corners.size(); ++v) {
			if (cut.sides[v] == -side) continue;
			number[v] = int(part.corners.size());
			part.corners.push_back(block.corners[v]);
			onCut.push_back(cut.sides[v] == 0);
		}
		const int firstCrossing = int(part.corners.size());
		for (const Crossing& crossing : cut.crossings)
			part.corners.push_back(crossing.point);
		onCut.resize(part.corners.size(), true);
		for (std::size_t f = 0; f < block.faces(); ++f) {
			const std::size_t begin = part.rings.size();
			bool              any   = false;
			for (int k = block.begin(f); k < block.end(f); ++k) {
				const int a = block.rings[std::size_t(k)], b = cut.following(f, k);
				if (number[std::size_t(a)] >= 0) part.rings.push_back(number[std::size_t(a)]);
				any = any || cut.sides[std::size_t(a)] == side;
				if (cut.sides[std::size_t(a)] * cut.sides[std::size_t(b)] < 0)
					part.rings.push_back(firstCrossing + cut.find(a, b));
			}
			if (any && part.rings.size() >= begin + 3) part.closeFace(block.planes[f]);
			else part.rings.resize(begin);
		}
		return addNewFace(part, onCut, plane);
	}

	/// Corners that lie on the cut and belong to no face of this part any more.
	void dropUnused(Block& part)
	{
		std::vector<int> number(part.corners.size(), -1);
		for (int corner : part.rings)
			number[std::size_t(corner)] = 0;
		int used = 0;
		for (std::size_t v = 0; v < number.size(); ++v)
			if (number[v] == 0) {
				part.corners[std::size_t(used)] = part.corners[v];
				number[v]                       = used++;
			}
		part.corners.resize(std::size_t(used));
		for (int& corner : part.rings)
			corner = number[std::size_t(corner)];
	}

} // namespace

Vector3 Block::middle() const
{
	Vector3 sum = Vector3::Zero();
	for (const Vector3& corner : corners)
		sum += corner;
	return sum / Real(corners.size());
}

Real Block::volume() const
{
	const Vector3 inner = middle();
	Real          six   = 0;
	for (std::size_t f = 0; f < faces(); ++f) {
		const Vector3 a = corners[std::size_t(rings[std::size_t(begin(f))])] - inner;
		for (int k = begin(f) + 2; k < end(f); ++k)
			six += a.dot((corners[std::size_t(rings[std::size_t(k - 1)])] - inner)
			                .cross(corners[std::size_t(rings[std::size_t(k)])] - inner));
	}
	return six / 6;
}

bool Block::holdsBall(const std::vector<Plane>& all, const Real& radius) const
{
	const Vector3        inner = middle();
	std::vector<Vector3> normals;
	std::vector<Real>    slacks;
	for (int plane : planes) {
		normals.push_back(all[std::size_t(plane)].normal);
		slacks.push_back(all[std::size_t(plane)].offset - normals.back().dot(inner));
	}
	if (*std::min_element(slacks.begin(), slacks.end()) >= radius) return true;
	Real reach = 0;
	for (const Vector3& corner : corners)
		reach = std::max(reach, Real((corner - inner).squaredNorm()));
	std::vector<Real> arrays;
	const int         padded = fillPlaneArrays(normals, slacks, 3, arrays);
	InscribedBall<3>  ball(arrays.data(), padded, int(normals.size()), 16 * sqrt(reach));
	return (ball.solve() || ball.solveWithMoreDigits()) && -ball.basis().infeasibility >= radius;
}

Block blockOf(const std::vector<Plane>& all, const std::vector<int>& which)
{
	HalfSpaces set;
	for (int plane : which) {
		set.normals.push_back(all[std::size_t(plane)].normal);
		set.offsets.push_back(all[std::size_t(plane)].offset);
	}
	const Polyhedron shape = polyhedron(set);
	Block            block;
	block.corners = shape.vertices;
	for (std::size_t f = 0; f < shape.faces.size(); ++f) {
		block.rings.insert(block.rings.end(), shape.faces[f].begin(), shape.faces[f].end());
		block.closeFace(which[std::size_t(shape.planeOfFace[f])]);
	}
	return block;
}

bool cutBlock(const Block& block, const std::vector<Plane>& all, int cut, const Real& on, Block& inner, Block& outer)
{
	const Cut where(block, all, all[std::size_t(cut)], on);
	if (takePart(where, -1, cut, inner) && takePart(where, 1, cut + 1, outer)) {
		dropUnused(inner);
		dropUnused(outer);
		return true;
	}
	try {
		for (int side = 0; side < 2; ++side) {
			std::vector<int> which = block.planes;
			which.push_back(cut + side);
			(side == 0 ? inner : outer) = blockOf(all, which);
		}
		return true;
	} catch (const std::invalid_argument&) {
		return false;
	}
}

} // namespace polytope
