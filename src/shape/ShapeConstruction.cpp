// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ShapeConstruction.hpp"

#include "numbers/NumberText.hpp"
#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"
#include "shape/PlaneMeeting.hpp"

#include <stdexcept>
#include <string>

// The way from half-spaces to vertices:
//  1. a linear program finds the largest inscribed ball, hence an inner point c, or that there is none: in exact arithmetic where the
//     digits of Real do not decide;
//  2. the planes' polar duals n/(d − n·c) have a convex hull, whose triangles are the vertices of the set, three planes
//     each. Rounding a dual point is the same as rounding its plane's normal and offset, whatever the set's aspect ratio;
//  3. triangles whose planes all meet in one point to rounding are joined into one vertex (TriangleClusters.hpp), and
//     faces that lose their area by it are dropped.
namespace polytope {
namespace {

	Triangles dualHull(const LocalPlanes& local)
	{
		std::vector<Vector3> duals;
		duals.reserve(local.normals.size());
		for (std::size_t i = 0; i < local.normals.size(); ++i)
			duals.push_back(local.normals[i] / local.slacks[i]);
		return hullTriangles(duals);
	}

	Meeting meeting(const LocalPlanes& local, const Indices& planes) { return polytope::meeting(local.normals, local.slacks, planes); }

	/// How far a point lies outside the set: negative inside.
	Real reachBeyond(const LocalPlanes& local, const Vector3& point)
	{
		Real farthest = -construction::horizon;
		for (std::size_t i = 0; i < local.normals.size(); ++i)
			farthest = std::max(farthest, Real(local.normals[i].dot(point) - local.slacks[i]));
		return farthest;
	}

	/// Whether a vertex is so far out that the set may be unbounded. By Cramer's rule, which also finds vertices at infinity.
	bool mayBeOpen(const LocalPlanes& local, const Triangles& triangles)
	{
		for (const Triangle& t : triangles) {
			if (local.isClosing(t[0]) || local.isClosing(t[1]) || local.isClosing(t[2])) return true;
			const Vector3 &a = local.normals[std::size_t(t[0])], &b = local.normals[std::size_t(t[1])],
			              &c          = local.normals[std::size_t(t[2])];
			const Vector3 scaledPoint = local.slacks[std::size_t(t[0])] * b.cross(c)
			        + local.slacks[std::size_t(t[1])] * c.cross(a) + local.slacks[std::size_t(t[2])] * a.cross(b);
			if (!(scaledPoint.norm() <= construction::farVertex * local.inradius * magnitude(a.dot(b.cross(c))))) return true;
		}
		return false;
	}

	/// Largest distance of a vertex from the inner point. Refuses what is unbounded, or flat to rounding.
	Real checkedExtent(const HalfSpaces& set, const LocalPlanes& local, const Triangles& triangles)
	{
		if (mayBeOpen(local, triangles)) refuseIfOpen(set);
		Real    extent = 0, misfit = 0;
		Indices planes(3);
		for (const Triangle& t : triangles) {
			std::copy(t.begin(), t.end(), planes.begin());
			const Meeting vertex = meeting(local, planes);
			extent               = std::max(extent, vertex.point.norm());
			misfit               = std::max(misfit, vertex.misfit);
		}
		// three nearly parallel planes meet far out, at a distance that rounding does not determine
		const Real least = construction::flatness * local.size(extent);
		if (!(local.inradius > least && misfit <= least)) refuseFlat(set);
		return extent;
	}

	/// Drops the later of two neighbouring planes that are one plane to rounding; whether there was any.
	bool dropCoplanar(LocalPlanes& local, const Edges& edges, const Real& extent)
	{
		std::vector<bool> repeated(local.normals.size(), false);
		for (const Edges::Edge& edge : edges) {
			const std::size_t i = std::size_t(edge.from), j = std::size_t(edge.to);
			if (i > j || repeated[i]) continue;
			const Real apart
			        = (local.normals[i] - local.normals[j]).norm() * extent + magnitude(local.slacks[i] - local.slacks[j]);
			if (apart <= construction::coplanarity * local.size(extent)) repeated[j] = true;
		}
		bool any = false;
		for (std::size_t i = repeated.size(); i-- > 0;)
			if (repeated[i]) {
				local.drop(i);
				any = true;
			}
		return any;
	}

	/// Each plane's clusters in counter-clockwise order, repetitions removed. Planes without a dual hull vertex: empty.
	std::vector<Indices> faceRings(std::size_t planes, const Triangles& triangles, const Edges& edges, const Clusters& clusters)
	{
		Indices start(planes, -1);
		for (std::size_t t = 0; t < triangles.size(); ++t)
			for (int corner : triangles[t])
				start[std::size_t(corner)] = int(t);
		std::vector<Indices> rings(planes);
		for (std::size_t i = 0; i < planes; ++i) {
			if (start[i] < 0) continue;
			Indices& ring = rings[i];
			ring.reserve(8);
			int t = start[i];
			do {
				const int vertex = clusters.of[std::size_t(t)];
				if (ring.empty() || ring.back() != vertex) ring.push_back(vertex);
				const Triangle&   corners = triangles[std::size_t(t)];
				const std::size_t here    = corners[0] == int(i) ? 0 : corners[1] == int(i) ? 1 : 2;
				t                         = edges.left(int(i), corners[(here + 2) % 3]);
			} while (t != start[i]);
			while (ring.size() > 1 && ring.front() == ring.back())
				ring.pop_back();
		}
		return rings;
	}

	/// Removes faces with fewer than three vertices and then vertices on fewer than three faces, until none is left.
	void removeDegenerate(std::vector<Indices>& rings, std::size_t vertices)
	{
		for (bool changed = true; changed;) {
			changed = false;
			Indices faces(vertices, 0);
			for (Indices& ring : rings) {
				if (ring.size() < 3) ring.clear();
				for (int vertex : ring)
					++faces[std::size_t(vertex)];
			}
			for (Indices& ring : rings) {
				const auto end = std::remove_if(
				        ring.begin(), ring.end(), [&](int vertex) { return faces[std::size_t(vertex)] < 3; });
				changed |= end != ring.end();
				ring.erase(end, ring.end());
			}
		}
	}

	/// Still in the local frame.
	Polyhedron assembled(const LocalPlanes& local, const Triangles& triangles, const Edges& edges, const Clusters& clusters)
	{
		std::vector<Indices> rings = faceRings(local.normals.size(), triangles, edges, clusters);
		removeDegenerate(rings, triangles.size());
		Polyhedron shape;
		Indices    number(triangles.size(), -1);
		// each face begins with the same vertex whichever way the hull cut its coplanar facets into triangles
		const auto earlier = [&](int a, int b) { return clusters.members[std::size_t(a)] < clusters.members[std::size_t(b)]; };
		const auto addFace = [&](std::size_t i) {
			std::rotate(rings[i].begin(), std::min_element(rings[i].begin(), rings[i].end(), earlier), rings[i].end());
			for (int& vertex : rings[i]) {
				int& final = number[std::size_t(vertex)];
				if (final < 0) {
					final = int(shape.vertices.size());
					shape.vertices.push_back(meeting(local, clusters.members[std::size_t(vertex)]).point);
				}
				vertex = final;
			}
			shape.faces.push_back(std::move(rings[i]));
			shape.planeOfFace.push_back(local.plane[i]);
		};
		for (std::size_t i = 0; i < rings.size(); ++i) // caps stand behind all others
			if (!rings[i].empty()) addFace(i);
		return shape;
	}

	/// Whether each edge is shared by two faces that run through it in opposite directions, and Euler's V − E + F = 2 holds.
	bool isClosed(const Polyhedron& shape)
	{
		std::vector<std::pair<int, int>> edges;
		edges.reserve(4 * shape.faces.size());
		for (const Indices& face : shape.faces)
			for (std::size_t k = 0; k < face.size(); ++k)
				edges.push_back({ face[k], face[(k + 1) % face.size()] });
		std::sort(edges.begin(), edges.end());
		if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
		for (const auto& edge : edges)
			if (!std::binary_search(edges.begin(), edges.end(), std::make_pair(edge.second, edge.first))) return false;
		return shape.vertices.size() + shape.faces.size() == edges.size() / 2 + 2;
	}

	void checkThickness(const HalfSpaces& set, const Real& thickness)
	{
		if (set.dimension != 2) return;
		if (!(thickness > 0 && (Eigen::numext::isfinite)(thickness)))
			throw std::invalid_argument("thickness: it must be positive and finite; give the body's length along z");
		if (!(thickness >= construction::smallestLength && thickness <= construction::largestLength))
			throw std::invalid_argument("thickness: it must lie between " + numberText(construction::smallestLength) + " and "
			        + numberText(construction::largestLength) + "; choose another unit of length");
	}

	/// Vertices and faces in the local frame.
	Polyhedron localShape(LocalPlanes& local, const HalfSpaces& set)
	{
		Triangles triangles = dualHull(local);
		Real      extent    = checkedExtent(set, local, triangles);
		Edges     edges(triangles);
		while (dropCoplanar(local, edges, extent)) {
			triangles = dualHull(local);
			extent    = checkedExtent(set, local, triangles);
			edges     = Edges(triangles);
		}
		const Real tolerance = construction::coincidence * local.size(extent);
		const auto apart     = [&](int left, int right) {
                        return missEachOther(local, cornersOfTwo(triangles[std::size_t(left)], triangles[std::size_t(right)]), tolerance);
		};
		const auto misfit  = [&local](const Indices& planes) { return meeting(local, planes).misfit; };
		const auto outside = [&local](const Indices& planes) { return reachBeyond(local, meeting(local, planes).point); };
		Polyhedron shape   = assembled(local, triangles, edges, cluster(triangles, edges, apart, misfit, outside, tolerance));
		// joining can only fail where the set is as thin as rounding somewhere; then slivers are accepted
		if (!isClosed(shape)) shape = assembled(local, triangles, edges, Clusters(triangles));
		return shape;
	}

} // namespace

LocalPolyhedron localPolyhedron(const HalfSpaces& unit, const Real& thickness)
{
	checkThickness(unit, thickness);
	LocalPlanes     local = aboutInnerPoint(unit);
	LocalPolyhedron result { localShape(local, unit), local.centre, local.unit };
	if (unit.dimension == 2) {
		const Real half = thickness / 2 / local.unit;
		for (Vector3& vertex : result.shape.vertices)
			vertex.z() = vertex.z() > 0 ? half : Real(-half);
	}
	return result;
}

Polyhedron polyhedron(const HalfSpaces& unit, Real thickness)
{
	const HalfSpaces set   = normalised(unit);
	LocalPolyhedron  local = localPolyhedron(set, thickness);
	for (Vector3& vertex : local.shape.vertices) {
		const bool top = vertex.z() > 0;
		vertex         = local.centre + local.unit * vertex;
		if (set.dimension == 2) vertex.z() = top ? Real(thickness / 2) : Real(-thickness / 2);
	}
	return std::move(local.shape);
}

void placeVertices(const HalfSpaces& unit, const Real& thickness, Polyhedron& shape)
{
	for (int plane : shape.planeOfFace)
		if (plane >= 0 && !(unit.offsets[std::size_t(plane)] > 0)) return; // the origin is not inside
	std::vector<Indices> planes(shape.vertices.size());
	for (Indices& at : planes)
		at.reserve(8);
	for (std::size_t f = 0; f < shape.faces.size(); ++f)
		for (int vertex : shape.faces[f])
			if (shape.planeOfFace[f] >= 0) planes[std::size_t(vertex)].push_back(shape.planeOfFace[f]);
	HalfSpaces all = unit;
	if (unit.dimension == 2) { // for the cap
		all.normals.push_back(Vector3::UnitZ());
		all.offsets.push_back(0);
	}
	for (std::size_t v = 0; v < planes.size(); ++v) {
		if (unit.dimension == 2) planes[v].push_back(int(unit.size()));
		std::sort(planes[v].begin(), planes[v].end());
		Vector3& vertex = shape.vertices[v];
		Vector3  placed = meeting(all.normals, all.offsets, planes[v]).point;
		if (unit.dimension == 2) placed.z() = vertex.z() > 0 ? Real(thickness / 2) : Real(-thickness / 2);
		// where blunt corners leave a vertex free to slide, it stays where its construction has put it
		if ((placed - vertex).norm() <= construction::coincidence * vertex.norm()) vertex = placed;
	}
}

HalfSpaces withoutRedundant(const HalfSpaces& unit)
{
	HalfSpaces kept;
	kept.dimension = unit.dimension;
	for (int i : polyhedron(unit).planeOfFace) {
		if (i < 0) continue;
		kept.normals.push_back(unit.normals[std::size_t(i)]);
		kept.offsets.push_back(unit.offsets[std::size_t(i)]);
	}
	return kept;
}

} // namespace polytope
