// SPDX-License-Identifier: GPL-2.0-or-later
#include "PairSets.hpp"
#include "Peer.hpp"

#include <src/contact/ContactQuery.hpp>
#include <src/program/SimplexLp.hpp>

#include <benchmark/benchmark.h>

#include <dlfcn.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>

/// Time per pair of our contact query and of the peers, on the same pairs. One benchmark iteration is one pass over a set.
/// Every method's answers are checked before it is measured; a method whose answers are wrong is measured all the same,
/// with the number of wrong ones beside it (counter `wrong`).

namespace polytope::benchmarks {
namespace {

	using samples::Pair;

	// ------------------------------------------------------------------------------------------------------------ ours

	struct Ours {
		const PairSet*          set;
		ContactSettings         settings;
		bool                    warm;
		std::vector<PairMemory> memory;
		ContactWorkspace        workspace;
		ContactResult           result;

		void query(const Pair& pair, PairMemory& own) { contactQuery(pair.placed(), settings, own, workspace, result); }

		/// Boon2012: the motion along the linear program's dual direction separates the pair.
		bool wayOutIsRight(const Pair& pair) const
		{
			if (!result.inContact) return !set->touching;
			Pair       free  = pair;
			const Real apart = -result.infeasibility / result.dualDirection.squaredNorm();
			free.centre2 += (1 + Real(1e-9)) * apart * result.dualDirection;
			return set->touching && samples::infeasibility(free) >= -1e-9 * free.size();
		}

		/// Models whose force is the gradient of an energy: force · a small motion along it is what the energy falls by.
		bool energyIsRight(const Pair& pair)
		{
			if (!result.inContact) return !set->touching;
			const bool perArea = settings.contactModel == ContactModel::Foundation;
			const auto whole   = [&](Real value) { return perArea ? value * result.area : value; };
			const bool asked   = settings.energy;
			settings.energy    = true;
			PairMemory none;
			query(pair, none);
			const Real    energy = whole(result.energy), force = whole(result.depth), step = Real(1e-4) * -result.infeasibility;
			const Vector3 normal = result.normal;
			Pair          there  = pair;
			there.centre2 += step * normal;
			const ContactResult here = result;
			none                     = PairMemory();
			query(there, none);
			const Real fall = energy - whole(result.energy);
			result          = here;
			settings.energy = asked;
			return set->touching && std::abs(fall - force * step) <= Real(1e-3) * force * step;
		}

		/// Wrong answers, pivots and iterations per pair of one pass.
		void check(benchmark::State& state)
		{
			int    wrong  = 0;
			double pivots = 0, iterations = 0, contacts = 0;
			for (std::size_t i = 0; i < set->pairs().size(); ++i) {
				if (!warm) memory[i] = PairMemory();
				else
					for (std::size_t k = set->steps.size(); k-- > 1;)
						query(set->steps[k][i], memory[i]);
				query(set->pairs()[i], memory[i]);
				pivots += result.simplexPivots;
				iterations += result.newtonIterations;
				contacts += result.inContact;
				wrong += !answered(result.status);
				const Pair& pair = set->pairs()[i];
				wrong += settings.contactModel == ContactModel::Boon2012 ? !wayOutIsRight(pair) : !energyIsRight(pair);
			}
			state.counters["wrong"]      = wrong;
			state.counters["pivots"]     = pivots / double(set->pairs().size());
			state.counters["iterations"] = iterations / double(set->pairs().size());
			state.counters["contacts"]   = contacts / double(set->pairs().size());
		}

		void run(benchmark::State& state)
		{
			memory.assign(set->pairs().size(), PairMemory());
			check(state);
			std::size_t  step = 0;
			const double size = double(set->pairs().size());
			for (auto _ : state) {
				const auto& pairs = warm ? set->walk(++step) : set->pairs();
				for (std::size_t i = 0; i < pairs.size(); ++i) {
					if (!warm) {
						PairMemory fresh;
						query(pairs[i], fresh);
					} else query(pairs[i], memory[i]);
					benchmark::DoNotOptimize(result.depth);
				}
			}
			state.counters["pair"]
			        = benchmark::Counter(size, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
		}
	};

	/// Time between two readings of the clock [ns], which the kernel's own measurement of a stage has in it.
	double clockCost()
	{
		using Clock         = std::chrono::steady_clock;
		constexpr int count = 1000;
		const auto    begin = Clock::now();
		for (int i = 0; i < count; ++i)
			benchmark::DoNotOptimize(Clock::now());
		return std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / count;
	}

	/// The linear program alone, frames and placing of planes included, by the kernel's own clock.
	void runLp(benchmark::State& state, const PairSet& set, bool warm)
	{
		Ours ours { &set, {}, warm, {}, {}, {} };
		ours.settings.contactModel = ContactModel::Boon2012;
		ours.settings.contactPoint = ContactPoint::ChebyshevCentre;
		ours.memory.assign(set.pairs().size(), PairMemory());
		ours.check(state);
		ours.settings.timed = true;
		std::size_t step    = 0;
		double      clock   = clockCost();
		for (int i = 0; i < 20; ++i)
			clock = std::min(clock, clockCost());
		for (auto _ : state) {
			const auto& pairs = warm ? set.walk(++step) : set.pairs();
			double      total = 0, count = 0;
			for (std::size_t i = 0; i < pairs.size(); ++i) {
				if (!warm) ours.memory[i] = PairMemory();
				ours.query(pairs[i], ours.memory[i]);
				// the clock goes on while another process has the core, for a hundred times what a pair takes
				if (ours.result.lpNanoseconds > 50000) continue;
				total += double(ours.result.lpNanoseconds) - clock;
				++count;
			}
			state.SetIterationTime(1e-9 * double(pairs.size()) * std::max(total, 1.0) / std::max(count, 1.0));
		}
		state.counters["pair"] = benchmark::Counter(
		        double(set.pairs().size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
	}

	// ----------------------------------------------------------------------------------------------------------- floor

	/// One pass over all planes of both bodies at one point, all in one frame already: the lower bound for any method on planes.
#define POLYTOPE_PASS(NAME, TARGET, WIDTH)                                                                                                 \
	__attribute__((target(TARGET))) Real NAME(const PairPlanes<Real, 3>& planes, const Real* x)                                        \
	{                                                                                                                                  \
		Real smallest;                                                                                                             \
		mostViolated<Real, 3, WIDTH>(planes, x, smallest);                                                                         \
		return smallest;                                                                                                           \
	}
	POLYTOPE_PASS(passV4, "arch=x86-64-v4", 4)
	POLYTOPE_PASS(passV3, "arch=x86-64-v3", 4)
	POLYTOPE_PASS(passV1, "arch=x86-64", 2)

	void runPass(benchmark::State& state, const PairSet& set)
	{
		const std::string name = instructionSet();
		const auto        pass = name == "AVX-512" ? passV4 : name == "AVX2" ? passV3 : passV1;
		struct Rows {
			std::vector<Real>   numbers;
			PairPlanes<Real, 3> planes;
		};
		std::vector<Rows> all(set.pairs().size());
		for (std::size_t i = 0; i < all.size(); ++i) {
			const Pair& pair   = set.pairs()[i];
			auto&       planes = all[i].planes;
			planes.first       = pair.shape[0]->paddedCount();
			planes.total       = planes.first + pair.shape[1]->paddedCount();
			all[i].numbers.resize(std::size_t(5 * planes.total));
			for (int k = 0; k < 3; ++k)
				planes.normal[k] = &all[i].numbers[std::size_t(k * planes.total)];
			planes.offset = &all[i].numbers[std::size_t(3 * planes.total)];
			planes.slack  = &all[i].numbers[std::size_t(4 * planes.total)];
			for (int body = 0; body < 2; ++body)
				for (int row = planes.begin(body); row < planes.end(body); ++row) {
					const int index = row - planes.begin(body);
					for (int k = 0; k < 3; ++k)
						planes.normal[k][row] = pair.shape[body]->normalArray(k)[index];
					planes.offset[row] = pair.shape[body]->offsetArray()[index];
				}
		}
		const Real x[3] = { Real(0.1), Real(0.2), Real(0.3) };
		for (auto _ : state)
			for (const Rows& rows : all)
				benchmark::DoNotOptimize(pass(rows.planes, x));
		state.counters["wrong"] = 0;
		state.counters["pair"]  = benchmark::Counter(
                        double(all.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
	}

	// ----------------------------------------------------------------------------------------------------------- peers

	/// A shape's arrays for a peer.
	struct PlainBody {
		std::vector<double> vertices, planes;
		std::vector<int>    faces;
		peer::Body          body;

		explicit PlainBody(const ConvexShape& shape)
		{
			for (const Vector3& v : shape.polyhedron().vertices)
				vertices.insert(vertices.end(), { v[0], v[1], v[2] });
			for (const auto& face : shape.polyhedron().faces) {
				faces.push_back(int(face.size()));
				faces.insert(faces.end(), face.begin(), face.end());
			}
			for (std::size_t i = 0; i < shape.planes().size(); ++i) {
				const Vector3& n = shape.planes().normals[i];
				planes.insert(planes.end(), { n[0], n[1], n[2], shape.planes().offsets[i] });
			}
			body = { int(vertices.size() / 3), vertices.data(), int(shape.polyhedron().faces.size()), int(faces.size()),
				faces.data(), int(planes.size() / 4), planes.data(), shape.boundingRadius() };
		}
	};

	struct PlainPair {
		int        body[2];
		peer::Pose pose[2];
	};

	PlainPair plain(const Pair& pair, peer::Peer& library, std::vector<std::pair<const ConvexShape*, int>>& known)
	{
		PlainPair out;
		for (int side = 0; side < 2; ++side) {
			const ConvexShape* shape = pair.shape[side].get();
			out.body[side]           = -1;
			for (const auto& [other, index] : known)
				if (other == shape) out.body[side] = index;
			if (out.body[side] < 0) {
				out.body[side] = library.add(PlainBody(*shape).body);
				known.emplace_back(shape, out.body[side]);
			}
			for (int i = 0; i < 3; ++i) {
				for (int j = 0; j < 3; ++j)
					out.pose[side].rotation[3 * i + j] = pair.rotation[side](i, j);
				out.pose[side].centre[i] = side == 0 ? 0 : pair.centre2[i];
			}
		}
		return out;
	}

	/// A peer's wrapper is in the folder of this program, as `libpeer_<library>.so`; empty if it was not built.
	std::filesystem::path peerFile(const std::string& library)
	{
		const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / ("libpeer_" + library + ".so");
		return std::filesystem::exists(file) ? file : std::filesystem::path();
	}

	/// Opened with symbols of its own: two of the libraries bring different versions of a third one.
	std::unique_ptr<peer::Peer> makePeer(const std::string& library, const std::string& factory)
	{
		void* const handle = dlopen(peerFile(library).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
		void* const make   = handle ? dlsym(handle, factory.c_str()) : nullptr;
		if (!make) throw std::runtime_error(dlerror());
		return std::unique_ptr<peer::Peer>(reinterpret_cast<peer::Peer* (*)()>(make)());
	}

	void runPeer(benchmark::State& state, const PairSet& set, const std::string& file, const std::string& factory)
	{
		const std::unique_ptr<peer::Peer>               library = makePeer(file, factory);
		std::vector<std::pair<const ConvexShape*, int>> known;
		std::vector<PlainPair>                          pairs;
		int                                             wrong = 0;
		for (const Pair& pair : set.pairs()) {
			pairs.push_back(plain(pair, *library, known));
			const PlainPair&   p      = pairs.back();
			const peer::Answer answer = library->query(p.body[0], p.pose[0], p.body[1], p.pose[1]);
			bool               right  = answer.touching == set.touching;
			if (answer.touching && answer.hasDepth) {
				// the motion that it returns must separate the pair, to the library's tolerance of 1e-4 … 1e-3
				Pair free = pair;
				for (int k = 0; k < 3; ++k)
					free.centre2[k] += answer.depth * answer.direction[k];
				right = right && std::isfinite(answer.depth) && samples::infeasibility(free) > -1e-3 * pair.size();
			}
			wrong += !right;
		}
		for (auto _ : state)
			for (const PlainPair& p : pairs)
				benchmark::DoNotOptimize(library->query(p.body[0], p.pose[0], p.body[1], p.pose[1]));
		state.counters["wrong"] = wrong;
		state.counters["pair"]  = benchmark::Counter(
                        double(pairs.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
	}

	void registerAll(const std::vector<NamedSet>& sets)
	{
		const auto add = [](const std::string& method, const NamedSet& set,
		                         const std::function<void(benchmark::State&, const PairSet&)>& run) {
			return benchmark::RegisterBenchmark((method + "/" + set.name).c_str(), [=](benchmark::State& state) {
				run(state, set.get());
			})->Unit(benchmark::kMicrosecond);
		};
		// "ours": the default of rock joints, as long as no energy is asked for
		const struct {
			const char*  name;
			ContactModel model;
			ContactPoint point;
			bool         energy, outline;
		} contacts[] = {
			{ "ours", ContactModel::Foundation, ContactPoint::AnalyticCentre, false, false },
			{ "ours with energy", ContactModel::Foundation, ContactPoint::AnalyticCentre, true, false },
			{ "ours with outline", ContactModel::Foundation, ContactPoint::AnalyticCentre, false, true },
			{ "ours, spring", ContactModel::Spring, ContactPoint::AnalyticCentre, true, false },
			{ "boon2012", ContactModel::Boon2012, ContactPoint::AnalyticCentre, false, false },
			{ "boon2012, Chebyshev centre", ContactModel::Boon2012, ContactPoint::ChebyshevCentre, false, false },
			{ "boon2012, centroid", ContactModel::Boon2012, ContactPoint::Centroid, false, false },
		};
		for (const NamedSet& set : sets) {
			for (const auto& contact : contacts)
				for (const bool warm : { false, true })
					add(std::string(contact.name) + (warm ? " warm" : " cold"), set,
					        [contact, warm](benchmark::State& state, const PairSet& set) {
						        Ours ours { &set, {}, warm, {}, {}, {} };
						        ours.settings.contactModel = contact.model;
						        ours.settings.contactPoint = contact.point;
						        ours.settings.energy       = contact.energy;
						        ours.settings.outline      = contact.outline;
						        ours.run(state);
					        });
			// a pair that its first basis dismisses has no linear program to time
			if (set.touching)
				for (const bool warm : { false, true })
					add(std::string("ours, LP alone ") + (warm ? "warm" : "cold"), set,
					        [warm](benchmark::State& state, const PairSet& set) { runLp(state, set, warm); })
					        ->UseManualTime();
			if (set.flat) continue;
			add("one pass", set, runPass);
			const struct {
				const char *name, *library, *factory;
			} peers[] = {
				{ "libccd MPR", "ccd", "makeCcd" },
				{ "CLP, as YADE calls it", "clp", "makeClpNew" },
				{ "CLP, one model reused", "clp", "makeClpReused" },
				{ "coal GJK+EPA", "coal", "makeCoal" },
			};
			for (const auto& peer : peers)
				if (!peerFile(peer.library).empty())
					add(peer.name, set, [peer](benchmark::State& state, const PairSet& set) {
						runPeer(state, set, peer.library, peer.factory);
					});
		}
	}

} // namespace
} // namespace polytope::benchmarks

int main(int argc, char** argv)
{
	const char* count = std::getenv("POLYTOPE_BENCHMARK_PAIRS");
	const auto  sets  = polytope::benchmarks::pairSets(count ? std::atoi(count) : 1000, std::getenv("POLYTOPE_BENCHMARK_HEAP"));
	polytope::benchmarks::registerAll(sets);
	benchmark::AddCustomContext("instruction set", polytope::instructionSet());
	benchmark::Initialize(&argc, argv);
	if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
	benchmark::RunSpecifiedBenchmarks();
	return 0;
}
