// SPDX-License-Identifier: GPL-2.0-or-later
#include "PairSets.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace polytope::benchmarks {

namespace {

	using samples::Pair;
	using Random = std::mt19937_64;
	using Shape  = std::shared_ptr<const ConvexShape>;

	constexpr Real touch = Real(-0.005), gap = Real(0.05); // s* over the smaller inscribed radius

	Shape solid(int faces, Real size = 1) { return ConvexShape::shared(regularSolid(faces, size), Real(0.1) * size); }

	/// Faces at random directions, all touching an ellipsoid with half axes 1: none is redundant.
	Shape hull(int faces, Random& random)
	{
		HalfSpaces set = regularSolid(4, 3);
		set.normals.resize(4);
		const Matrix3 turn = samples::randomRotation(random);
		for (std::size_t i = 0; i < 4; ++i) {
			set.normals[i] = turn * set.normals[i];
			set.offsets[i] = 1;
		}
		while (int(set.size()) < faces) {
			set.normals.push_back(samples::randomDirection(random));
			set.offsets.push_back(1);
		}
		return ConvexShape::shared(set, Real(0.1));
	}

	Pair randomlyTurned(const Shape& one, const Shape& two, Real target, Random& random)
	{
		Pair pair;
		pair.shape[0] = one;
		pair.shape[1] = two;
		for (Matrix3& rotation : pair.rotation)
			rotation = samples::randomRotation(random);
		samples::moveTo(pair, samples::randomDirection(random), target * pair.inscribedRadius());
		return pair;
	}

	/// Turned together, so that no axis is a coordinate axis.
	Pair inSomeFrame(const Pair& pair, Random& random) { return samples::turned(pair, samples::randomRotation(random)); }

	/// A cube on another's face, shifted and turned about the normal: what rests in a heap.
	Pair stacked(Random& random)
	{
		Pair pair;
		pair.shape[0] = pair.shape[1] = solid(6);
		pair.rotation[1]              = Eigen::AngleAxis<Real>(samples::uniform(random, 0, 1), Vector3::UnitZ()).toRotationMatrix();
		const Real half               = pair.inscribedRadius();
		pair.centre2
		        = Vector3(samples::uniform(random, -half, half), samples::uniform(random, -half, half), 2 * half * (1 + touch));
		return inSomeFrame(pair, random);
	}

	/// Two cubes that cross at the middle parts of an edge each.
	Pair crossedEdges(Random& random)
	{
		Pair pair;
		pair.shape[0] = pair.shape[1] = solid(6);
		const auto about   = [](Real angle, const Vector3& axis) { return Eigen::AngleAxis<Real>(angle, axis).toRotationMatrix(); };
		const Real quarter = Real(M_PI) / 4;
		pair.rotation[0]   = about(quarter, Vector3::UnitX());
		pair.rotation[1]
		        = about(quarter, Vector3::UnitY()) * about(samples::uniform(random, Real(-0.3), Real(0.3)), Vector3::UnitX());
		const Real half = pair.inscribedRadius();
		Vector3    direction(samples::uniform(random, -half, half) / 4, samples::uniform(random, -half, half) / 4,
		           2 * std::sqrt(Real(2)) * half);
		samples::moveTo(pair, direction.normalized(), touch * half);
		return inSomeFrame(pair, random);
	}

	Shape sliver(Random& random)
	{
		const Real aspect = samples::decades(random, -3, -1);
		return ConvexShape::shared(
		        samples::stretched(samples::randomPlanes(12, random), Vector3(1, random() % 2 ? 1 : aspect, aspect)),
		        Real(0.05) * aspect);
	}

	Shape withRedundantPlanes(Random& random)
	{
		HalfSpaces set = regularSolid(6, 1);
		for (int i = 0; i < 6; ++i) {
			set.normals.push_back(samples::randomDirection(random));
			set.offsets.push_back(samples::uniform(random, Real(1.0), Real(1.2)));
		}
		return ConvexShape::shared(set, Real(0.05));
	}

	/// Motion of a pair in a step of DEM, too small to separate it: along the contact as much as across it.
	Pair afterStep(const Pair& pair, Random& random)
	{
		Pair          next  = pair;
		const Real    small = Real(1e-4);
		const Vector3 axis  = pair.dimension() == 2 ? Vector3(Vector3::UnitZ()) : samples::randomDirection(random);
		next.centre2 += small * pair.size() * samples::randomDirection(random, pair.dimension());
		next.rotation[1] = Eigen::AngleAxis<Real>(small, axis).toRotationMatrix() * next.rotation[1];
		return next;
	}

	using MakePair = std::function<Pair(Random&)>;

	/// Twenty bodies of a kind, of which each pair takes two.
	MakePair ofKind(const std::function<Shape(Random&)>& make, std::uint64_t seed, Real target)
	{
		return [=, shapes = std::vector<Shape>()](Random& random) mutable {
			Random own(seed);
			while (shapes.size() < 20)
				shapes.push_back(make(own));
			const Shape one = shapes[random() % 20], two = shapes[random() % 20];
			return randomlyTurned(one, two, target, random);
		};
	}

	MakePair ofSolid(int faces, Real target)
	{
		return [=](Random& random) { return randomlyTurned(solid(faces), solid(faces), target, random); };
	}

	MakePair squares()
	{
		return [shape = ConvexShape::shared(samples::rectangle(1, 1), Real(0.1))](Random& random) {
			Pair pair;
			for (int body = 0; body < 2; ++body) {
				pair.shape[body]    = shape;
				pair.rotation[body] = samples::randomRotation(random, 2);
			}
			samples::moveTo(pair, samples::randomDirection(random, 2), touch * pair.inscribedRadius());
			return pair;
		};
	}

	/// `count` pairs that stay in contact, or apart, through all their steps.
	PairSet lastingPairs(const std::string& name, bool touching, int count, const MakePair& make, Random random)
	{
		constexpr std::size_t stepCount = 6;
		PairSet               set { name, touching, {} };
		set.steps.resize(stepCount);
		for (int trial = 0; int(set.pairs().size()) < count; ++trial) {
			if (trial > 1000 * count) throw std::runtime_error(name + ": hardly a pair lasts");
			std::vector<Pair> steps { make(random) };
			while (steps.size() < stepCount)
				steps.push_back(afterStep(steps.back(), random));
			// a thin pair may be separated by the steps: then it is not a lasting contact
			const auto other = [&](const Pair& pair) { return (samples::infeasibility(pair) < 0) != touching; };
			if (std::any_of(steps.begin(), steps.end(), other)) continue;
			for (std::size_t k = 0; k < stepCount; ++k)
				set.steps[k].push_back(steps[k]);
		}
		return set;
	}

} // namespace

/// Contacts of a heap from the file that heap.py writes: faces and circumradius of both, rotation of both (row by row),
/// from centre 1 to centre 2.
std::vector<Pair> heapPairs(const char* path)
{
	std::ifstream                         file(path);
	std::map<std::pair<int, Real>, Shape> shapes;
	std::vector<Pair>                     pairs;
	std::string                           line;
	while (std::getline(file, line)) {
		std::replace(line.begin(), line.end(), ',', ' ');
		std::istringstream numbers(line);
		Pair               pair;
		for (auto& shape : pair.shape) {
			Real faces, circumradius;
			numbers >> faces >> circumradius;
			Shape& known = shapes[{ int(faces), circumradius }];
			if (!known) known = solid(int(faces), circumradius);
			shape = known;
		}
		for (Matrix3& rotation : pair.rotation)
			for (int i = 0; i < 9; ++i)
				numbers >> rotation(i / 3, i % 3);
		for (int k = 0; k < 3; ++k)
			numbers >> pair.centre2[k];
		if (!numbers) throw std::runtime_error(std::string(path) + ": not a row of 25 numbers: " + line);
		pairs.push_back(pair);
	}
	if (pairs.empty()) throw std::runtime_error(std::string(path) + ": no contacts");
	return pairs;
}

std::vector<NamedSet> pairSets(int count, const char* heap)
{
	std::vector<NamedSet> sets;
	const auto            add = [&](const std::string& name, bool touching, const MakePair& make, bool flat = false) {
                const std::uint64_t seed = sets.size() + 1;
                sets.push_back({ name, touching, flat, [=, made = std::make_shared<PairSet>()]() -> const PairSet& {
                                        if (made->steps.empty()) *made = lastingPairs(name, touching, count, make, Random(seed));
                                        return *made;
                                } });
	};
	const std::pair<const char*, int> solids[]
	        = { { "tetrahedron", 4 }, { "cube", 6 }, { "octahedron", 8 }, { "dodecahedron", 12 }, { "icosahedron", 20 } };
	for (const auto& [name, faces] : solids)
		add(name, true, ofSolid(faces, touch));
	for (const auto& [name, faces] : solids)
		add(std::string(name) + " apart", false, ofSolid(faces, gap));
	for (const int faces : { 20, 50, 100, 200 })
		add("hull " + std::to_string(faces), true, ofKind([faces](Random& random) { return hull(faces, random); }, 1000, touch));
	add("stacked cubes", true, stacked);
	add("crossed edges", true, crossedEdges);
	add("sizes 1:100", true, [](Random& random) { return randomlyTurned(solid(6, 100), solid(6), touch, random); });
	add("slivers", true, ofKind(sliver, 7, Real(-0.1)));
	add("redundant planes", true, ofKind(withRedundantPlanes, 8, touch));
	add("squares, 2-D", true, squares(), true);
	if (heap)
		add("settled heap", true,
		        [pairs = heapPairs(heap), next = std::size_t(0)](Random&) mutable { return pairs[next++ % pairs.size()]; });
	return sets;
}

} // namespace polytope::benchmarks
