// SPDX-License-Identifier: GPL-2.0-or-later
#include "Families.hpp"

#include "shape/ShapeConstruction.hpp"

namespace polytope::search {

using namespace samples;

namespace {

	const int solidFaces[] = { 4, 6, 8, 12, 20 };

	using Shape = std::shared_ptr<const ConvexShape>;

	/// Scaled to the size, with one of the usual corner radii.
	Shape shapeOf(HalfSpaces set, Real size, Random& random)
	{
		const Real rounding[] = { 0, Real(0.02), Real(0.3), Real(0.9) };
		for (Real& offset : set.offsets)
			offset *= size;
		const Real inner = *std::min_element(set.offsets.begin(), set.offsets.end());
		return std::make_shared<const ConvexShape>(set, rounding[random() % 4] * std::max(inner, Real(0)));
	}

	HalfSpaces someSolid(Random& random) { return regularSolid(solidFaces[random() % 5], 1); }

	HalfSpaces someBox(Random& random, int dimension)
	{
		const Real y = decades(random, -1, 0), z = decades(random, -1, 0);
		return dimension == 3 ? cuboid(1, y, z) : rectangle(1, y);
	}

	/// Hull of points near a sphere, centred approximately.
	HalfSpaces someHull(Random& random, int dimension)
	{
		std::vector<Vector3> points;
		const int            count = dimension + 1 + int(random() % (dimension == 3 ? 30 : 12));
		for (int i = 0; i < count; ++i)
			points.push_back(uniform(random, Real(0.6), 1) * randomDirection(random, dimension));
		Vector3 middle = Vector3::Zero();
		for (const Vector3& p : points)
			middle += p / Real(points.size());
		for (Vector3& p : points)
			p -= middle;
		return hullOf(points, dimension);
	}

	HalfSpaces somePlanes(Random& random, int dimension) { return randomPlanes(4 + int(random() % 57), random, dimension); }

	HalfSpaces someSet(Random& random, int dimension)
	{
		switch (random() % 4) {
			case 0: return dimension == 3 ? someSolid(random) : someBox(random, 2);
			case 1: return someHull(random, dimension);
			case 2: return someBox(random, dimension);
			default: return randomPlanes(4 + int(random() % 20), random, dimension);
		}
	}

	HalfSpaces flattened(const HalfSpaces& set, Random& random, Real least)
	{
		const Real aspect = decades(random, least, 0);
		if (set.dimension == 2) return stretched(set, Vector3(1, aspect, 1));
		const int kind = int(random() % 3); // plate, needle, something between
		return stretched(set, Vector3(1, kind == 0 ? Real(1) : kind == 1 ? aspect : std::sqrt(aspect), aspect));
	}

	Pair anyOrientation(const Shape& one, const Shape& two, Random& random)
	{
		Pair pair;
		pair.shape[0] = one;
		pair.shape[1] = two;
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random, one->dimension());
		return pair;
	}

	/// Any orientations, body 2 from any side.
	Poses anywhere(const Shape& one, const Shape& two)
	{
		return [=](Random& random) {
			Pair pair = anyOrientation(one, two, random);
			approach(pair, randomDirection(random, pair.dimension()), someInfeasibility(pair, random));
			return pair;
		};
	}

	/// Two shapes of one making, of sizes 1 and 10^[smallest, 0].
	template <class Make> Poses twoOf(Random& random, Make make, Real smallest = -3)
	{
		const Shape one = shapeOf(make(random), 1, random);
		return anywhere(one, shapeOf(make(random), decades(random, smallest, 0), random));
	}

	template <int D> Poses hulls(Random& random)
	{
		return twoOf(random, [](Random& r) { return someHull(r, D); });
	}

	template <int D> Poses halfSpaces(Random& random)
	{
		return twoOf(random, [](Random& r) { return somePlanes(r, D); });
	}

	template <int D> Poses slivers(Random& random)
	{
		return twoOf(random, [](Random& r) { return flattened(someSet(r, D), r, -4); });
	}

	template <int D> Poses extremes(Random& random)
	{
		return twoOf(random, [](Random& r) { return flattened(someSet(r, D), r, -8); }, -6);
	}

	Poses solids(Random& random) { return twoOf(random, someSolid); }

	/// Every plane once, twice or thrice, in any order.
	template <int D> Poses duplicates(Random& random)
	{
		return twoOf(random, [](Random& r) {
			HalfSpaces        set = someSet(r, D);
			const std::size_t own = set.size();
			for (std::size_t i = 0; i < own; ++i)
				for (int copies = int(r() % 3); copies > 0; --copies) {
					set.normals.push_back(set.normals[i]);
					set.offsets.push_back(set.offsets[i]);
				}
			for (std::size_t i = set.size() - 1; i > 0; --i) {
				const std::size_t j = r() % (i + 1);
				std::swap(set.normals[i], set.normals[j]);
				std::swap(set.offsets[i], set.offsets[j]);
			}
			return set;
		});
	}

	/// Nearly parallel planes: those of samples::nearlyParallelPair(), and of other shapes; some aligned.
	template <int D> Poses nearlyParallel(Random& random)
	{
		const Pair made = nearlyParallelPair(random, D);
		Shape      one = made.shape[0], two = made.shape[1];
		if (random() % 2) {
			one = shapeOf(withNearCopies(someSet(random, D), 1 + int(random() % 6), random), 1, random);
			two = random() % 3
			        ? shapeOf(withNearCopies(someSet(random, D), 1 + int(random() % 6), random), decades(random, -3, 0), random)
			        : one;
		}
		return [=](Random& r) {
			Pair    pair      = anyOrientation(one, two, r);
			Vector3 direction = randomDirection(r, D);
			if (r() % 3 == 0) {
				pair.rotation[1] = pair.rotation[0];
				direction        = pair.rotation[0].col(int(r() % D));
			}
			approach(pair, direction, someInfeasibility(pair, r));
			return pair;
		};
	}

	/// A feature that can touch: a vertex, an edge or a face.
	struct Feature {
		std::vector<Vector3> points, normals;
	};

	/// The features with `corners` points: all vertices, edges or faces.
	std::vector<Feature> featuresOf(const ConvexShape& shape, int corners)
	{
		const Polyhedron&    body = shape.polyhedron();
		std::vector<Feature> all;
		const auto           add = [&](const std::vector<int>& corner) {
                        Feature feature;
                        for (std::size_t f = 0; f < body.faces.size(); ++f) {
                                if (body.planeOfFace[f] < 0) continue;
                                const auto& face = body.faces[f];
                                const bool  has  = std::all_of(corner.begin(), corner.end(),
				                    [&](int v) { return std::find(face.begin(), face.end(), v) != face.end(); });
                                if (has) feature.normals.push_back(shape.planes().normals[std::size_t(body.planeOfFace[f])]);
                        }
                        for (int v : corner) {
                                feature.points.push_back(body.vertices[std::size_t(v)]);
                                if (shape.dimension() == 2) feature.points.back().z() = 0;
                        }
                        if (!feature.normals.empty()) all.push_back(feature);
		};
		if (corners == 1)
			for (std::size_t v = 0; v < body.vertices.size(); ++v)
				add({ int(v) });
		for (std::size_t f = 0; f < body.faces.size() && corners > 1; ++f) {
			if (body.planeOfFace[f] < 0) continue;
			const auto& face = body.faces[f];
			if (corners > 2) add(face);
			else
				for (std::size_t k = 0; k < face.size(); ++k)
					add({ face[k], face[(k + 1) % face.size()] });
		}
		return all;
	}

	/// Turns a to b, then about b.
	Matrix3 turning(const Vector3& a, const Vector3& b, Real twist, int dimension)
	{
		// between nearly opposite vectors Eigen's quaternion is not quite unit
		if (dimension == 3)
			return (Quaternion(Eigen::AngleAxis<Real>(twist, b)) * Quaternion::FromTwoVectors(a, b))
			        .normalized()
			        .toRotationMatrix();
		return Eigen::AngleAxis<Real>(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()), Vector3::UnitZ()).toRotationMatrix();
	}

	/// Features with so many corners touch: exactly but for rounding, or with a small gap or overlap.
	Poses touching(const Shape& one, const Shape& two, int corners1, int corners2)
	{
		const std::vector<Feature> features[2] = { featuresOf(*one, corners1), featuresOf(*two, corners2) };
		return [=](Random& random) {
			Pair          pair  = anyOrientation(one, two, random);
			const Vector3 along = random() % 4 ? randomDirection(random, one->dimension())
			                                   : Vector3(Vector3::Unit(int(random() % one->dimension())));
			Vector3       meet[2];
			for (int body = 0; body < 2; ++body) {
				const Feature& feature = features[body][random() % features[body].size()];
				Vector3        out = Vector3::Zero(), point = Vector3::Zero();
				Real           sum = 0;
				for (const Vector3& normal : feature.normals)
					out += uniform(random, Real(0.01), 1) * normal;
				for (const Vector3& corner : feature.points) {
					const Real weight = random() % 4 ? uniform(random, 0, 1) : Real(0.01);
					point += weight * corner;
					sum += weight;
				}
				// edges of both bodies parallel, now and then
				const Real twist = random() % 3 ? uniform(random, 0, 6) : Real(0);
				pair.rotation[body]
				        = turning(out.normalized(), body == 0 ? along : Vector3(-along), twist, one->dimension());
				meet[body] = pair.rotation[body] * (point / sum);
			}
			Real gap = 0;
			if (random() % 3) gap = (random() % 2 ? 1 : -1) * decades(random, -15, -1) * pair.inscribedRadius();
			pair.centre2 = meet[0] - meet[1] + gap * along;
			return pair;
		};
	}

	template <int corners1, int corners2, int D> Poses touches(Random& random)
	{
		const auto  make = [&] { return random() % 2 ? someSet(random, D) : flattened(someSet(random, D), random, -2); };
		const Shape one = shapeOf(make(), 1, random), two = shapeOf(make(), decades(random, -2, 0), random);
		return random() % 2 ? touching(one, two, corners1, corners2) : touching(one, two, corners2, corners1);
	}

	Real someEighth(Random& random) { return Real(int(random() % 33) - 16) / 8; }

	/// Boxes stacked on a grid: parallel faces, common planes, edges and vertices; tilted by 0 or 1e-16 … 1e-3.
	template <int D> Poses stacked(Random& random)
	{
		const Real half[] = { Real(0.25), Real(0.5), 1, 2 };
		const auto make   = [&] {
                        return D == 3 ? cuboid(half[random() % 4], half[random() % 4], half[random() % 4])
			                : rectangle(half[random() % 4], half[random() % 4]);
		};
		const Shape one = shapeOf(make(), 1, random), two = random() % 3 ? shapeOf(make(), 1, random) : one;
		return [=](Random& r) {
			Pair pair;
			pair.shape[0] = one;
			pair.shape[1] = two;
			for (int k = 0; k < D; ++k)
				pair.centre2[k] = someEighth(r);
			if (r() % 2) {
				const Vector3 axis = D == 3 ? randomDirection(r) : Vector3(Vector3::UnitZ());
				pair.rotation[1]   = Eigen::AngleAxis<Real>(decades(r, -16, -3), axis).toRotationMatrix();
			}
			if (r() % 2) approach(pair, (r() % 2 ? 1 : -1) * Vector3::Unit(int(r() % D)), someInfeasibility(pair, r));
			if (r() % 2) pair = turned(pair, randomRotation(r, D));
			return pair;
		};
	}

	/// samples::thinPair(): thin across two or three axes.
	Poses thin(Random& random)
	{
		const Pair made = thinPair(int(random() % 6), random);
		return [=](Random& r) {
			Pair pair = thinPair(int(r() % 6), r);
			if (r() % 2) { // the same bodies elsewhere
				pair.shape[1] = made.shape[1];
				approach(pair, pair.centre2.normalized(), someInfeasibility(pair, r));
			}
			return pair;
		};
	}

	/// Cones of up to 40 sides, regular or not: all sides meet in the tip, and of regular ones they have the same slack along a line. On a box, half of them
	/// upright on their base or tip.
	Poses cones(Random& random)
	{
		const int  sides   = 5 + int(random() % 36);
		const Real slope   = decades(random, -1, 1);
		const bool regular = random() % 2;
		HalfSpaces set;
		const auto add = [&](const Vector3& normal, Real offset) {
			set.normals.push_back(normal);
			set.offsets.push_back(offset);
		};
		add(-Vector3::UnitZ(), Real(0.25));
		for (int k = 0; k < sides; ++k) {
			const Real    angle  = 2 * Real(M_PI) * (k + (regular ? Real(0) : uniform(random, 0, Real(0.5)))) / sides;
			const Vector3 normal = Vector3(std::cos(angle), std::sin(angle), slope).normalized();
			add(normal, Real(0.75) * normal[2]);
		}
		const Shape box = shapeOf(cuboid(1, 1, Real(0.4)), 1, random), cone = shapeOf(set, decades(random, -3, 0), random);
		return [=](Random& r) {
			Pair    pair      = anyOrientation(box, cone, r);
			Vector3 direction = randomDirection(r, 3);
			if (r() % 2) {
				const Real up    = r() % 2 ? Real(1) : Real(-1);
				const auto turn  = Eigen::AngleAxis<Real>(uniform(r, 0, 6), Vector3::UnitZ()).toRotationMatrix();
				pair.rotation[1] = pair.rotation[0] * turn * Vector3(1, up, up).asDiagonal();
				direction        = pair.rotation[0].col(2);
			}
			approach(pair, direction, someInfeasibility(pair, r));
			return r() % 2 ? pair : swapped(pair);
		};
	}

	/// Coincident, concentric, or one inside the other.
	template <int D> Poses inside(Random& random)
	{
		const Shape outer = shapeOf(someSet(random, D), 1, random);
		const Shape inner = random() % 2 ? outer : shapeOf(someSet(random, D), decades(random, -4, Real(-0.5)), random);
		return [=](Random& r) {
			Pair pair = anyOrientation(outer, inner, r);
			if (r() % 2) pair.rotation[1] = pair.rotation[0];
			if (r() % 3) pair.centre2 = decades(r, -16, Real(-0.1)) * outer->inscribedRadius() * randomDirection(r, D);
			return r() % 2 ? pair : swapped(pair);
		};
	}

} // namespace

const std::vector<Family>& families()
{
	static const std::vector<Family> all = {
		{ "solids", solids },
		{ "hulls", hulls<3> },
		{ "half-spaces", halfSpaces<3> },
		{ "slivers", slivers<3> },
		{ "extremes", extremes<3> },
		{ "stacked", stacked<3> },
		{ "face-face", touches<3, 3, 3> },
		{ "edge-face", touches<2, 3, 3> },
		{ "edge-edge", touches<2, 2, 3> },
		{ "vertex-face", touches<1, 3, 3> },
		{ "vertex-edge", touches<1, 2, 3> },
		{ "vertex-vertex", touches<1, 1, 3> },
		{ "nearly-parallel", nearlyParallel<3> },
		{ "duplicates", duplicates<3> },
		{ "thin", thin },
		{ "cones", cones },
		{ "inside", inside<3> },
		{ "hulls-2d", hulls<2> },
		{ "half-spaces-2d", halfSpaces<2> },
		{ "slivers-2d", slivers<2> },
		{ "extremes-2d", extremes<2> },
		{ "stacked-2d", stacked<2> },
		{ "edge-edge-2d", touches<3, 3, 2> },
		{ "vertex-edge-2d", touches<1, 3, 2> },
		{ "vertex-vertex-2d", touches<1, 1, 2> },
		{ "nearly-parallel-2d", nearlyParallel<2> },
		{ "duplicates-2d", duplicates<2> },
		{ "inside-2d", inside<2> },
	};
	return all;
}

void approach(Pair& pair, const Vector3& direction, Real target)
{
	ContactSettings settings;
	settings.tolerance    = -1e6;
	settings.contactPoint = ContactPoint::ChebyshevCentre;
	PairMemory memory;
	Real       way = pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius() + 2 * std::abs(target);
	for (int step = 0; step < 30; ++step) {
		pair.centre2               = way * direction;
		const ContactResult result = query(pair, settings, &memory);
		const Real          slope = result.dualDirection.dot(direction), over = result.infeasibility - target;
		if (!(slope > 0) || !(std::abs(over) > tolerance::rounding * pair.reach())) return;
		way -= over / slope;
		if (way < 0) way = 0; // beyond the centre the motion separates the bodies again
	}
}

Real someInfeasibility(const Pair& pair, Random& random)
{
	const Real inner = pair.inscribedRadius();
	switch (random() % 8) {
		case 0:
		case 1: return decades(random, -13, 0) * inner;
		case 2: return uniform(random, -100, 100) * tolerance::rounding * pair.reach();
		default: return -decades(random, -13, Real(-0.3)) * inner;
	}
}

} // namespace polytope::search
