// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/RegularSolids.hpp"
#include "shape/ShapeConstruction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

/// Shapes with known answers and checks that hold for every shape, for the tests of shape construction.
namespace polytope::samples {

inline const Real lengths[] = { 1e-9, 1e-3, 1, 1e3, 1e4 };

inline Vector3 someDirection(std::mt19937_64& random)
{
	std::normal_distribution<double> gauss;
	const double                     x = gauss(random), y = gauss(random), z = gauss(random);
	return Vector3(x, y, z).normalized();
}

inline Matrix3 someRotation(std::mt19937_64& random)
{
	std::normal_distribution<double> gauss;
	const double                     w = gauss(random), x = gauss(random), y = gauss(random), z = gauss(random);
	return Eigen::Quaternion<Real>(w, x, y, z).normalized().toRotationMatrix();
}

inline void add(HalfSpaces& set, const Vector3& normal, Real offset)
{
	set.normals.push_back(normal);
	set.offsets.push_back(offset);
}

inline HalfSpaces box(Real halfX, Real halfY, Real halfZ)
{
	HalfSpaces set;
	const Real half[3] = { halfX, halfY, halfZ };
	for (int k = 0; k < 3; ++k)
		for (int side = -1; side <= 1; side += 2)
			add(set, side * Vector3::Unit(k), half[k]);
	return set;
}

/// Pyramid over a regular polygon in z = 0, apex at height above its centre.
inline HalfSpaces pyramid(int sides, Real radius, Real height)
{
	HalfSpaces set;
	add(set, -Vector3::UnitZ(), 0);
	for (int k = 0; k < sides; ++k) {
		const Real    angle  = 2 * Real(M_PI) * (k + Real(0.3)) / sides;
		const Vector3 normal = Vector3(height * std::cos(angle), height * std::sin(angle), radius).normalized();
		add(set, normal, normal.dot(Vector3(0, 0, height)));
	}
	return set;
}

inline HalfSpaces regularPolygon(int sides, Real inradius)
{
	HalfSpaces set;
	set.dimension = 2;
	for (int k = 0; k < sides; ++k) {
		const Real angle = 2 * Real(M_PI) * k / sides;
		add(set, Vector3(std::cos(angle), std::sin(angle), 0), inradius);
	}
	return set;
}

/// Planes tangent to the ellipsoid with the given half axes, at random directions.
inline HalfSpaces tangentPlanes(int count, const Vector3& halfAxes, std::mt19937_64& random)
{
	HalfSpaces set;
	for (int i = 0; i < count; ++i) {
		const Vector3 normal = someDirection(random);
		add(set, normal, halfAxes.cwiseProduct(normal).norm());
	}
	return set;
}

inline Real extentOf(const Polyhedron& shape)
{
	Real extent = 0;
	for (const Vector3& vertex : shape.vertices)
		extent = std::max(extent, (vertex - shape.vertices.front()).norm());
	return extent;
}

/// Volume by tetrahedra from one vertex: nothing in common with the divergence theorem about an inner point.
inline Real volumeFromVertex(const Polyhedron& shape, std::size_t apex = 0)
{
	Real volume = 0;
	for (const auto& face : shape.faces)
		for (std::size_t k = 2; k < face.size(); ++k) {
			Matrix3 corners;
			corners << shape.vertices[face[0]] - shape.vertices[apex], shape.vertices[face[k - 1]] - shape.vertices[apex],
			        shape.vertices[face[k]] - shape.vertices[apex];
			volume += corners.determinant() / 6;
		}
	return volume;
}

/// Closed, oriented outwards, V − E + F = 2; every vertex within rounding of its faces' planes and inside all others.
inline void expectSound(const Polyhedron& shape, const HalfSpaces& set, Real relative = 1e-13)
{
	std::map<std::pair<int, int>, int> edges;
	std::vector<int>                   facesAt(shape.vertices.size(), 0);
	ASSERT_EQ(shape.faces.size(), shape.planeOfFace.size());
	Real size = extentOf(shape);
	for (const Vector3& vertex : shape.vertices)
		size = std::max(size, vertex.norm());
	for (std::size_t f = 0; f < shape.faces.size(); ++f) {
		const auto& face = shape.faces[f];
		ASSERT_GE(face.size(), 3u);
		for (std::size_t k = 0; k < face.size(); ++k) {
			++edges[{ face[k], face[(k + 1) % face.size()] }];
			++facesAt[std::size_t(face[k])];
			if (shape.planeOfFace[f] < 0) continue;
			const std::size_t plane = std::size_t(shape.planeOfFace[f]);
			EXPECT_NEAR(set.normals[plane].dot(shape.vertices[std::size_t(face[k])]), set.offsets[plane], relative * size);
		}
	}
	for (const auto& edge : edges) {
		EXPECT_EQ(edge.second, 1);
		EXPECT_EQ(edges.count({ edge.first.second, edge.first.first }), 1u);
	}
	EXPECT_EQ(int(shape.vertices.size()) - int(edges.size()) / 2 + int(shape.faces.size()), 2);
	for (int faces : facesAt)
		EXPECT_GE(faces, 3);
	for (const Vector3& vertex : shape.vertices)
		for (std::size_t i = 0; i < set.size(); ++i)
			EXPECT_LE(set.normals[i].dot(vertex) - set.offsets[i], relative * size);
	EXPECT_GT(volumeFromVertex(shape), 0);
}

/// How many faces have how many corners.
inline std::map<int, int> facesByCorners(const Polyhedron& shape)
{
	std::map<int, int> count;
	for (const auto& face : shape.faces)
		++count[int(face.size())];
	return count;
}

/// What std::invalid_argument says, or "" if nothing was thrown.
template <class Call> std::string refusal(const Call& call)
{
	try {
		call();
	} catch (const std::invalid_argument& error) {
		return error.what();
	}
	return "";
}

inline bool says(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

} // namespace polytope::samples
