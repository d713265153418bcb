// SPDX-License-Identifier: GPL-2.0-or-later
//
// Any numbers as planes or points: refused with a sentence that names the argument, or a sound shape.
#include "Bytes.hpp"

#include "shape/ConstructionTolerances.hpp"
#include "shape/ConvexShape.hpp"
#include "shape/ShapeConstruction.hpp"
#include "shape/ShapeFactory.hpp"

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

using namespace polytope;
using namespace polytope::fuzz;

namespace {

/// Distance of a plane to a vertex that is allowed: the lower bound for a shape that is accepted (construction::flatness).
Real allowance(const Polyhedron& shape)
{
	Real size = 0;
	for (const Vector3& vertex : shape.vertices)
		size = std::max({ size, vertex.norm(), (vertex - shape.vertices.front()).norm() });
	return construction::flatness * size;
}

void checkPolyhedron(const Polyhedron& shape, const HalfSpaces& set)
{
	POLYTOPE_REQUIRE(
	        shape.faces.size() == shape.planeOfFace.size() && shape.vertices.size() >= 4, "%zu vertices", shape.vertices.size());
	for (const Vector3& vertex : shape.vertices)
		POLYTOPE_REQUIRE(vertex.allFinite(), "vertex %g %g %g", vertex[0], vertex[1], vertex[2]);
	const Real                         allowed = allowance(shape);
	std::map<std::pair<int, int>, int> edges;
	for (std::size_t f = 0; f < shape.faces.size(); ++f) {
		const auto& face = shape.faces[f];
		POLYTOPE_REQUIRE(face.size() >= 3, "face %zu has %zu corners", f, face.size());
		for (std::size_t k = 0; k < face.size(); ++k) {
			POLYTOPE_REQUIRE(face[k] >= 0 && std::size_t(face[k]) < shape.vertices.size(), "face %zu corner %d", f, face[k]);
			++edges[{ face[k], face[(k + 1) % face.size()] }];
			const int plane = shape.planeOfFace[f];
			if (plane < 0) continue;
			POLYTOPE_REQUIRE(std::size_t(plane) < set.size(), "plane %d of %zu", plane, set.size());
			const Real apart = set.normals[std::size_t(plane)].dot(shape.vertices[std::size_t(face[k])])
			        - set.offsets[std::size_t(plane)];
			POLYTOPE_REQUIRE(std::abs(apart) <= allowed, "face %zu: a corner is %g from its plane, %g allowed", f,
			        double(apart), double(allowed));
		}
	}
	for (const auto& edge : edges)
		POLYTOPE_REQUIRE(edge.second == 1 && edges.count({ edge.first.second, edge.first.first }) == 1, "edge %d–%d",
		        edge.first.first, edge.first.second);
	POLYTOPE_REQUIRE(shape.vertices.size() + shape.faces.size() == edges.size() / 2 + 2, "not closed");
	for (const Vector3& vertex : shape.vertices)
		for (std::size_t i = 0; i < set.size(); ++i) {
			const Real outside = set.normals[i].dot(vertex) - set.offsets[i];
			POLYTOPE_REQUIRE(
			        outside <= allowed, "a vertex is %g outside of plane %zu, %g allowed", double(outside), i, double(allowed));
		}
}

void checkShape(const ConvexShape& shape)
{
	const HalfSpaces& set = shape.planes();
	for (std::size_t i = 0; i < set.size(); ++i) {
		POLYTOPE_REQUIRE(std::abs(set.normals[i].norm() - 1) <= 2 * construction::unitLength, "normal %zu has length %.17g", i,
		        double(set.normals[i].norm()));
		POLYTOPE_REQUIRE(std::isfinite(set.offsets[i]), "offset %zu", i);
	}
	checkPolyhedron(shape.polyhedron(), set);
	const Real            allowed = allowance(shape.polyhedron());
	const MassProperties& mass    = shape.mass();
	POLYTOPE_REQUIRE(std::isfinite(mass.volume) && mass.volume > 0, "volume %g", double(mass.volume));
	POLYTOPE_REQUIRE(mass.centroid.allFinite(), "centroid");
	POLYTOPE_REQUIRE(mass.inertia.allFinite() && mass.inertia.diagonal().minCoeff() > 0, "inertia %g",
	        double(mass.inertia.diagonal().minCoeff()));
	for (std::size_t i = 0; i < set.size(); ++i)
		POLYTOPE_REQUIRE(set.normals[i].dot(mass.centroid) - set.offsets[i] <= allowed, "the centroid is outside of plane %zu", i);
	POLYTOPE_REQUIRE(std::isfinite(shape.boundingRadius()), "bounding radius");
	POLYTOPE_REQUIRE(shape.inscribedRadius() > 0 && shape.inscribedRadius() <= shape.boundingRadius() + allowed,
	        "inscribed radius %g, bounding %g", double(shape.inscribedRadius()), double(shape.boundingRadius()));
	std::set<int> basis;
	for (int k = 0; k <= shape.dimension(); ++k) {
		const int plane = shape.inscribedBasis()[std::size_t(k)];
		POLYTOPE_REQUIRE(
		        plane >= 0 && plane < shape.planeCount() && basis.insert(plane).second, "inscribed basis: plane %d", plane);
	}
}

void construct(Bytes& bytes)
{
	const int  choice    = bytes.byte();
	const int  dimension = choice % 16 == 15 ? int(std::int8_t(bytes.byte())) : choice % 2 ? 2 : 3;
	const bool points = choice & 16, redundant = choice & 32;
	const Real cornerRadius = choice & 64 ? bytes.number() : Real(0);
	const Real thickness    = choice & 128 ? bytes.number() : Real(1);
	HalfSpaces set;
	if (points) {
		const Real           coplanar = bytes.flag() ? bytes.number() : Real(0);
		std::vector<Vector3> cloud;
		for (int count = bytes.below(48); count > 0 && !bytes.empty(); --count) {
			Vector3 point = bytes.vector();
			if (dimension == 2 && bytes.below(8)) point.z() = 0;
			cloud.push_back(point);
		}
		set       = hullOf(cloud, dimension, coplanar);
		Real size = 0;
		for (const Vector3& point : cloud)
			size = std::max({ size, point.norm(), (point - cloud.front()).norm() });
		for (const Vector3& point : cloud)
			for (std::size_t i = 0; i < set.size(); ++i)
				POLYTOPE_REQUIRE(
				        set.normals[i].dot(point) - set.offsets[i] <= (construction::flatness + 10 * coplanar) * size,
				        "a point is cut off");
	} else set = planes(bytes, dimension);
	checkShape(ConvexShape(set, cornerRadius, thickness));
	// as bodies are made
	ShapeOptions options;
	options.thickness     = thickness;
	options.keepRedundant = redundant;
	options.cornerRadius  = cornerRadius;
	checkShape(*centralShape(set, options).shape);
}

/// "name: what is wrong": names an argument.
bool isRefusal(const std::string& message)
{
	for (const char* name : { "normals", "offsets", "dimension", "thickness", "cornerRadius", "points", "coplanar", "shape" })
		if (message.rfind(std::string(name) + ": ", 0) == 0 && message.size() > std::strlen(name) + 10) return true;
	return false;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	Bytes bytes(data, size);
	try {
		construct(bytes);
	} catch (const std::invalid_argument& refusal) {
		POLYTOPE_REQUIRE(isRefusal(refusal.what()), "%s", refusal.what());
	} catch (const std::exception& error) {
		POLYTOPE_REQUIRE(false, "not a refusal: %s", error.what());
	}
	return 0;
}
