// SPDX-License-Identifier: GPL-2.0-or-later
#include "PairAxes.hpp"

#include <stdexcept>

namespace polytope::samples {
namespace {

	using Random = std::mt19937_64;
	using Shape  = std::shared_ptr<const ConvexShape>;

	Matrix3 about(const Vector3& axis, Real angle) { return Eigen::AngleAxis<Real>(angle, axis.normalized()).toRotationMatrix(); }

	/// The shape with corners rounded by a tenth of the inscribed ball, as bodies in a scene are unless told otherwise.
	Shape rounded(const HalfSpaces& set, Real part = 0.1)
	{
		const Real inscribed = ConvexShape(set, 0).inscribedRadius();
		return ConvexShape::shared(set, part * inscribed);
	}

	Pair pairOf(const Shape& one, const Shape& two)
	{
		Pair pair;
		pair.shape[0] = one;
		pair.shape[1] = two;
		return pair;
	}

	/// Body 2 to aside + t·direction with s* = target, by bisection.
	void approach(Pair& pair, const Vector3& aside, const Vector3& direction, Real target)
	{
		Real near = 0,
		     far  = 2 * (pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius()) + aside.norm() + 2 * std::abs(target);
		for (int step = 0; step < 70; ++step) {
			const Real middle                           = (near + far) / 2;
			pair.centre2                                = aside + middle * direction;
			(infeasibility(pair) < target ? near : far) = middle;
		}
	}

	Pair anyTurn(const Pair& pair, Random& random) { return turned(pair, randomRotation(random, pair.dimension())); }

	const int solids[] = { 4, 6, 8, 12, 20 };

	HalfSpaces anySolid(Random& random) { return random() % 6 ? regularSolid(solids[random() % 5], 1) : randomPlanes(30, random); }

	/// Random polygon within the unit circle's neighbourhood.
	HalfSpaces anyPolygon(Random& random) { return randomPlanes(4 + int(random() % 9), random, 2); }

	Vector3 inPlane(Random& random, Real reach) { return { uniform(random, -reach, reach), uniform(random, -reach, reach), 0 }; }

	/// Octahedron with a vertex, or cube with an edge (along x), or a cube's face, towards −z.
	Matrix3 vertexDown() { return Matrix3::Identity(); }
	Matrix3 edgeDown() { return about(Vector3::UnitX(), Real(M_PI) / 4); }

	/// Features that meet: body 1 below with the first one up, body 2 above with the second one down; −s* = overlap × size.
	Pair features(const std::string& kind, Real overlap, Random& random)
	{
		const Shape cube = rounded(cuboid(1, 1, 1)), slab = rounded(cuboid(Real(0.8), Real(0.7), Real(0.9)));
		const Shape octahedron = rounded(regularSolid(8, 1));
		const Real  turn       = uniform(random, -3, 3);
		const auto  tilted     = [&](const Matrix3& rotation) {
                        return Matrix3(about(randomDirection(random), uniform(random, 0, Real(0.2))) * rotation);
		};
		Pair    pair;
		Vector3 aside = Vector3::Zero();
		if (kind == "face on face") {
			pair             = pairOf(cube, slab);
			pair.rotation[1] = about(Vector3::UnitZ(), turn);
			aside            = inPlane(random, Real(0.6));
		} else if (kind == "vertex on face") {
			pair             = pairOf(cube, octahedron);
			pair.rotation[1] = tilted(about(Vector3::UnitZ(), turn) * vertexDown());
			aside            = inPlane(random, Real(0.8));
		} else if (kind == "edge on edge") {
			pair             = pairOf(cube, cube);
			pair.rotation[0] = tilted(edgeDown());
			pair.rotation[1] = tilted(about(Vector3::UnitZ(), uniform(random, Real(0.5), Real(2.5))) * edgeDown());
			aside            = inPlane(random, Real(0.3));
		} else if (kind == "polygons") {
			pair = pairOf(rounded(anyPolygon(random)), rounded(anyPolygon(random)));
			for (Matrix3& rotation : pair.rotation)
				rotation = randomRotation(random, 2);
			approach(pair, aside, randomDirection(random, 2), -overlap * pair.size());
			return pair;
		} else if (kind == "any solids") {
			pair = pairOf(rounded(anySolid(random)), rounded(anySolid(random)));
			for (Matrix3& rotation : pair.rotation)
				rotation = randomRotation(random);
			approach(pair, aside, randomDirection(random), -overlap * pair.size());
			return pair;
		} else throw std::logic_error("no such kind: " + kind);
		approach(pair, aside, Vector3::UnitZ(), -overlap * pair.size());
		return anyTurn(pair, random);
	}

	/// Two shapes in any orientation, −s* = part of the smaller inscribed ball.
	Pair anyhow(const Shape& one, const Shape& two, Real part, Random& random)
	{
		Pair pair = pairOf(one, two);
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random, pair.dimension());
		approach(pair, Vector3::Zero(), randomDirection(random, pair.dimension()), -part * pair.inscribedRadius());
		return pair;
	}

	// ------------------------------------------------------------------------------------------------------ axes

	Pair depthPair(Real value, const std::string& kind, Random& random) { return features(kind, value, random); }

	Pair aspectPair(Real aspect, const std::string& kind, Random& random)
	{
		const Real thin = 1 / aspect;
		if (kind == "plate and cube") return anyhow(rounded(cuboid(1, 1, thin)), rounded(cuboid(1, 1, 1)), Real(0.1), random);
		if (kind == "needle and cube") return anyhow(rounded(cuboid(1, thin, thin)), rounded(cuboid(1, 1, 1)), Real(0.1), random);
		if (kind == "crossed needles")
			return anyhow(rounded(cuboid(1, thin, thin)), rounded(cuboid(1, thin, thin)), Real(0.1), random);
		if (kind == "plate on plate") {
			Pair pair        = pairOf(rounded(cuboid(1, 1, thin)), rounded(cuboid(1, Real(0.9), thin)));
			pair.rotation[1] = about(Vector3::UnitZ(), uniform(random, -3, 3));
			approach(pair, inPlane(random, Real(0.5)), Vector3::UnitZ(), Real(-0.1) * thin);
			return anyTurn(pair, random);
		}
		if (kind == "slivers") {
			Shape sliver[2];
			for (Shape& shape : sliver)
				shape = rounded(stretched(randomPlanes(20, random), Vector3(1, std::sqrt(thin), thin)));
			return anyhow(sliver[0], sliver[1], Real(0.1), random);
		}
		// polygons
		return anyhow(rounded(rectangle(1, thin)), rounded(stretched(anyPolygon(random), Vector3(1, thin, 1))), Real(0.1), random);
	}

	Pair sizePair(Real ratio, const std::string& kind, Random& random)
	{
		if (kind == "polygons") {
			HalfSpaces small = anyPolygon(random);
			for (Real& offset : small.offsets)
				offset /= ratio;
			return anyhow(rounded(anyPolygon(random)), rounded(small), Real(0.05), random);
		}
		const Shape small = scaled(*rounded(anySolid(random)), 1 / ratio);
		if (kind == "any solids") return anyhow(rounded(anySolid(random)), small, Real(0.05), random);
		Pair pair        = pairOf(rounded(cuboid(1, 1, 1)), small);
		pair.rotation[1] = randomRotation(random);
		if (kind == "on a face") approach(pair, inPlane(random, Real(0.9)), Vector3::UnitZ(), Real(-0.05) * pair.inscribedRadius());
		else // at a vertex
			approach(pair, Vector3::Zero(), Vector3(1, 1, 1).normalized(), Real(-0.05) * pair.inscribedRadius());
		pair = anyTurn(pair, random);
		return random() % 2 ? pair : swapped(pair);
	}

	Pair placedPair(Real, const std::string& kind, Random& random) { return features(kind, Real(1e-3), random); }
	/// The pair with both centres rounded where the scene has them.
	Pair roundedPlaces(Real distance, const std::string& kind, Random& random)
	{
		Pair          pair  = placedPair(distance, kind, random);
		const Vector3 first = distance * pair.size() * randomDirection(random);
		volatile Real second[3]; // as State.pos stores it
		for (int k = 0; k < 3; ++k) {
			second[k]       = first[k] + pair.centre2[k];
			pair.centre2[k] = second[k] - first[k];
		}
		return pair;
	}

	Pair anglePair(Real angle, const std::string& kind, Random& random)
	{
		if (kind == "polygons") {
			Pair pair        = pairOf(rounded(rectangle(1, 1)), rounded(rectangle(Real(0.8), Real(0.9))));
			pair.rotation[1] = about(Vector3::UnitZ(), random() % 2 ? angle : -angle);
			approach(pair, Vector3(uniform(random, Real(-0.5), Real(0.5)), 0, 0), Vector3::UnitY(), Real(-1e-4));
			return anyTurn(pair, random);
		}
		Pair       pair  = pairOf(rounded(cuboid(1, 1, 1)), rounded(cuboid(Real(0.8), Real(0.7), Real(0.9))));
		const Real along = uniform(random, -3, 3);
		pair.rotation[1]
		        = about(Vector3(std::cos(along), std::sin(along), 0), angle) * about(Vector3::UnitZ(), uniform(random, -3, 3));
		// a wedge-shaped overlap that ends within the face, or one that does not
		const Real overlap = kind == "wedge" ? Real(0.1) * angle : Real(1e-2);
		approach(pair, inPlane(random, Real(0.6)), Vector3::UnitZ(), -overlap);
		return anyTurn(pair, random);
	}

	/// Two planes of one body that differ by an angle, about a line through the contact or far from it.
	Pair twinsPair(Real angle, const std::string& kind, Random& random)
	{
		HalfSpaces    set   = cuboid(Real(0.8), Real(0.7), Real(0.9));
		const Vector3 aside = randomDirection(random, 2);
		const Vector3 twin  = (-Vector3::UnitZ() + angle * aside).normalized();
		set.normals.push_back(twin);
		// through the face, so that both have a share, or through the vertex that is farthest along it, so that it is redundant
		const Vector3 corner(aside[0] > 0 ? Real(0.8) : Real(-0.8), aside[1] > 0 ? Real(0.7) : Real(-0.7), Real(-0.9));
		set.offsets.push_back(kind == "redundant" ? twin.dot(corner) : twin.dot(Vector3(Real(0.2), Real(-0.1), Real(-0.9))));
		Pair pair = pairOf(rounded(cuboid(1, 1, 1)), rounded(set));
		if (kind == "both have a share, vertex below") pair.shape[0] = rounded(regularSolid(8, 1));
		pair.rotation[1] = about(Vector3::UnitZ(), uniform(random, -3, 3));
		approach(pair, inPlane(random, Real(0.3)), Vector3::UnitZ(), Real(-1e-3));
		return anyTurn(pair, random);
	}

	/// A ball of planes at random directions, none of them redundant.
	HalfSpaces ball(int planes, Random& random)
	{
		HalfSpaces set = regularSolid(4, 3);
		for (Real& offset : set.offsets)
			offset = 1;
		const Matrix3 turn = randomRotation(random);
		for (Vector3& normal : set.normals)
			normal = turn * normal;
		while (int(set.size()) < planes) {
			set.normals.push_back(randomDirection(random));
			set.offsets.push_back(1);
		}
		return set;
	}

	/// Pyramid with its apex at height −1 and its base at 1: all planes but one meet in one point.
	HalfSpaces spike(int planes)
	{
		HalfSpaces set;
		set.normals.push_back(Vector3::UnitZ());
		set.offsets.push_back(1);
		for (int i = 1; i < planes; ++i) {
			const Real    angle  = 2 * Real(M_PI) * (i + Real(0.3)) / (planes - 1);
			const Vector3 normal = Vector3(std::cos(angle), std::sin(angle), -1).normalized();
			set.normals.push_back(normal);
			set.offsets.push_back(normal.dot(-Vector3::UnitZ()));
		}
		return set;
	}

	HalfSpaces drum(int planes)
	{
		HalfSpaces set;
		for (int side = 1; side >= -1; side -= 2) {
			set.normals.push_back(side * Vector3::UnitZ());
			set.offsets.push_back(1);
		}
		for (int i = 2; i < planes; ++i) {
			const Real angle = 2 * Real(M_PI) * (i + Real(0.3)) / (planes - 2);
			set.normals.push_back(Vector3(std::cos(angle), std::sin(angle), 0));
			set.offsets.push_back(1);
		}
		return set;
	}

	Pair planesPair(Real value, const std::string& kind, Random& random)
	{
		const int planes = int(value);
		if (kind == "balls") return anyhow(rounded(ball(planes, random)), rounded(ball(planes, random)), Real(1e-3), random);
		if (kind == "spike on face") {
			Pair pair        = pairOf(rounded(cuboid(1, 1, 1)), rounded(spike(planes)));
			pair.rotation[1] = about(randomDirection(random), uniform(random, 0, Real(0.2)));
			approach(pair, inPlane(random, Real(0.6)), Vector3::UnitZ(), Real(-1e-3));
			return anyTurn(pair, random);
		}
		// drum on drum, end on end
		Pair pair        = pairOf(rounded(drum(std::max(planes, 5))), rounded(drum(std::max(planes, 5))));
		pair.rotation[1] = about(Vector3::UnitZ(), uniform(random, -3, 3));
		approach(pair, inPlane(random, Real(0.6)), Vector3::UnitZ(), Real(-1e-3));
		return anyTurn(pair, random);
	}

	Pair redundantPair(Real copies, const std::string& kind, Random& random)
	{
		HalfSpaces set = cuboid(Real(0.8), Real(0.7), Real(0.9));
		for (int i = 0; i < int(copies); ++i) {
			Vector3 normal = -Vector3::UnitZ();
			Real    room   = 0;
			if (kind == "through vertices" || kind == "outside") normal = randomDirection(random);
			if (kind == "outside") room = uniform(random, Real(0.1), 2);
			if (kind == "all faces again") normal = Vector3(set.normals[random() % 6]);
			set.normals.push_back(normal);
			// the box's farthest vertex along the normal
			set.offsets.push_back(
			        std::abs(normal[0]) * Real(0.8) + std::abs(normal[1]) * Real(0.7) + std::abs(normal[2]) * Real(0.9) + room);
		}
		Pair pair = pairOf(rounded(cuboid(1, 1, 1)), rounded(set));
		pair.rotation[1]
		        = about(randomDirection(random), uniform(random, 0, Real(0.3))) * about(Vector3::UnitZ(), uniform(random, -3, 3));
		approach(pair, inPlane(random, Real(0.6)), Vector3::UnitZ(), Real(-1e-3));
		return anyTurn(pair, random);
	}

	/// Features that touch but for `gap` roundings of the size; exact before the pair is turned, but for 1/√3 in the octahedron's normals.
	Pair touchingPair(Real gap, const std::string& kind, Random& random)
	{
		const Shape cube = rounded(cuboid(1, 1, 1)), octahedron = rounded(regularSolid(8, 1));
		Pair        pair;
		const auto  place = [&](const Shape& one, const Shape& two, Real x, Real y, Real z) {
                        pair         = pairOf(one, two);
                        pair.centre2 = Vector3(x, y, z);
		};
		if (kind == "vertex on vertex") place(cube, cube, 2, 2, 2);
		else if (kind == "vertex on edge") place(cube, octahedron, 2, Real(0.25), 1);
		else if (kind == "vertex on face") place(cube, octahedron, Real(0.25), Real(-0.125), 2);
		else if (kind == "edge on edge, parallel") place(cube, cube, 2, 2, Real(0.25));
		else if (kind == "edge on edge, crossed") place(octahedron, octahedron, 1, Real(0), 1);
		else if (kind == "edge on face") place(cube, cube, Real(0.25), 0, 1 + std::sqrt(Real(2)));
		else // face on face
			place(cube, cube, Real(0.25), Real(-0.125), 2);
		if (kind == "edge on face") pair.rotation[1] = edgeDown();
		if (kind == "edge on edge, crossed") {
			pair             = pairOf(cube, cube);
			pair.rotation[0] = edgeDown();
			pair.rotation[1] = about(Vector3::UnitY(), Real(M_PI) / 4);
			pair.centre2     = Vector3(Real(0.125), Real(0.25), 2 * std::sqrt(Real(2)));
		}
		pair.centre2 += gap * tolerance::rounding * pair.size() * pair.centre2.normalized();
		return anyTurn(pair, random);
	}

	Pair coincidentPair(Real shift, const std::string& kind, Random& random)
	{
		const Shape shape = rounded(kind == "any planes" ? randomPlanes(20, random) : regularSolid(std::stoi(kind), 1));
		Pair        pair  = pairOf(shape, shape);
		pair.centre2      = shift * shape->boundingRadius() * randomDirection(random);
		return anyTurn(pair, random);
	}

	Pair insidePair(Real ratio, const std::string& kind, Random& random)
	{
		const Shape outer = rounded(anySolid(random)),
		            inner = scaled(*rounded(anySolid(random)), ratio * outer->inscribedRadius() / 4);
		Pair pair         = pairOf(outer, inner);
		if (kind == "anywhere") pair.centre2 = uniform(random, 0, Real(0.5)) * outer->inscribedRadius() * randomDirection(random);
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random);
		return random() % 2 ? pair : swapped(pair);
	}

	/// −s* = value × corner radius, which is 5e-3 of the size.
	Pair deepPair(Real value, const std::string& kind, Random& random)
	{
		Pair       pair         = features(kind, value * Real(5e-3), random);
		const Real cornerRadius = Real(5e-3) * pair.size();
		for (Shape& shape : pair.shape)
			shape = ConvexShape::shared(shape->planes(), cornerRadius);
		return pair;
	}

	Pair unitPair(Real, const std::string& kind, Random& random) { return features(kind, Real(1e-3), random); }
	Pair inUnits(Real unit, const std::string& kind, Random& random) { return scaled(unitPair(unit, kind, random), unit); }

	/// 10^low … 10^high, low < high or not.
	std::vector<Real> powers(int from, int to, int stride = 1)
	{
		std::vector<Real> values;
		for (int k = from; stride > 0 ? k <= to : k >= to; k += stride)
			values.push_back(std::stod("1e" + std::to_string(k))); // the double nearest to it
		return values;
	}

	std::vector<Real> joined(std::vector<Real> one, const std::vector<Real>& two)
	{
		one.insert(one.end(), two.begin(), two.end());
		return one;
	}

} // namespace

const std::vector<PairAxis>& pairAxes()
{
	static const std::vector<std::string> contacts { "face on face", "vertex on face", "edge on edge", "any solids", "polygons" };
	static const std::vector<std::string> solidContacts { "face on face", "vertex on face", "edge on edge", "any solids" };
	static const std::vector<PairAxis>    axes {
		   { "depth", powers(-1, -15, -1), contacts, depthPair },
		   { "aspect", powers(0, 10),
		           { "plate and cube", "needle and cube", "plate on plate", "crossed needles", "slivers", "polygons" }, aspectPair },
		   { "size", powers(0, 8), { "any solids", "on a face", "at a vertex", "polygons" }, sizePair },
		   { "coordinates", joined({ 0 }, powers(0, 12)), contacts, roundedPlaces, placedPair },
		   { "angle", powers(-1, -17, -1), { "wedge", "whole face", "polygons" }, anglePair },
		   { "twins", powers(-1, -17, -1), { "both have a share", "both have a share, vertex below", "redundant" }, twinsPair },
		   { "planes", { 4, 6, 10, 20, 50, 100, 200, 600, 2000 }, { "balls", "spike on face", "drum on drum" }, planesPair, nullptr,
		           false, 100 },
		   { "redundant", { 0, 1, 3, 10, 30, 100, 1000 }, { "face again", "all faces again", "through vertices", "outside" },
		           redundantPair, nullptr, false, 100 },
		   { "touching", { -10000, -1000, -300, -150, -100, -70, -50, -30, -10, -3, -1, 0, 1, 3, 10, 30, 100, 1000, 10000 },
		           { "vertex on vertex", "vertex on edge", "vertex on face", "edge on edge, parallel", "edge on edge, crossed",
		                   "edge on face", "face on face" },
		           touchingPair },
		   { "coincident", joined({ 0 }, powers(-18, -1)), { "4", "6", "8", "12", "20", "any planes" }, coincidentPair },
		   { "inside", { 1, Real(0.3), Real(0.1), 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8 }, { "concentric", "anywhere" },
		           insidePair },
		   { "deep", { 0.1, 0.3, 0.6, 0.9, 0.99, 1, 1.01, 1.1, 1.5, 2, 3, 6, 10, 30, 60, 90 }, solidContacts, deepPair },
		   { "units", joined(powers(-60, -15, 15), joined(powers(-12, 6, 3), powers(15, 45, 15))), contacts, inUnits, unitPair, true },
	};
	return axes;
}

} // namespace polytope::samples
