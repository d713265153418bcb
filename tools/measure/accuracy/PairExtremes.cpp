// SPDX-License-Identifier: GPL-2.0-or-later
//
// Pairs from easy to extreme, each contact in double beside exact arithmetic, as CSV on standard output:
//
//     polytope_extremes [--quick] SAMPLES [AXIS …]
//
//     polytope_extremes --transitions SAMPLES
//
// SAMPLES per value and kind of an axis (fewer, and none if quick, where references are costly). Pairs depend on axis, value, kind and number only.
#include "PairAxes.hpp"
#include "Reference.hpp"

#include <cstdlib>
#include <cstring>
#include <iostream>
#include <sstream>
#include <stdexcept>

using namespace polytope;
using namespace polytope::samples;

namespace {

/// One number per axis, value, kind and sample, the same on every machine.
std::uint64_t seedOf(const std::string& text)
{
	std::uint64_t hash = 14695981039346656037u; // FNV-1a
	for (unsigned char c : text)
		hash = (hash ^ c) * 1099511628211u;
	return hash;
}

void writeRow(const std::string& head, const Comparison& c, Real deviation, Real moved)
{
	std::cout << head << ',' << statusName(c.result.status) << ',' << c.result.inContact << ',' << c.touches << ',' << c.within << ','
	          << c.size << ',' << c.inscribed / c.size << ',' << c.infeasibility << ',' << c.infeasibilityError << ','
	          << c.infeasibilityRounding << ',' << c.depth << ',' << c.depthError << ',' << c.depthRounding << ',' << c.centreError
	          << ',' << c.centreRounding << ',' << c.normalError << ',' << c.normalRounding << ',' << c.forceError << ',' << c.compared
	          << ',' << c.finite << ',' << c.bounded << ',' << c.free << ',' << deviation << ',' << moved << ','
	          << c.result.simplexPivots << ',' << c.result.newtonIterations << ',' << c.nanoseconds << ",\n";
}

void writeRefusal(const std::string& head, std::string message)
{
	for (char& c : message)
		if (c == ',' || c == '\n' || c == '"') c = ';';
	std::cout << head << ",refused,0,0,0" << std::string(23, ',') << message << '\n';
}

void sample(const PairAxis& axis, Real value, const std::string& kind, int number)
{
	std::ostringstream name;
	name << axis.name << '/' << kind << '/' << value << '/' << number;
	const std::uint64_t seed = seedOf(name.str());
	std::ostringstream  head;
	head << axis.name << ",\"" << kind << "\"," << value << ',' << number;
	const auto make = [&](PairAxis::Maker maker) {
		std::mt19937_64 random(seed);
		return maker(value, kind, random);
	};
	try {
		const Pair       pair  = make(axis.make);
		const Comparison c     = compareWithReference(pair);
		Real             other = 0, moved = 0;
		if (axis.intended) {
			const Pair      intended = make(axis.intended);
			ContactSettings settings;
			settings.section           = true;
			const ContactResult before = query(intended, settings);
			const Real          unit   = axis.scaled ? value : Real(1);
			other                      = deviation(c.result, before, unit, intended.size());
			moved                      = (c.result.infeasibility / unit - before.infeasibility) / intended.size();
		}
		writeRow(head.str(), c, other, moved);
	} catch (const std::invalid_argument& refusal) {
		writeRefusal(head.str(), refusal.what());
	}
}

/// Body 2 pressed into body 1 along the contact's first normal, the paper's, from 0.3 to 4 corner radii: changes of the contact where its
/// status changes.
void pressIn(const PairAxis& deep, const std::string& kind, int number)
{
	std::mt19937_64 random(seedOf("transitions/" + kind + '/' + std::to_string(number)));
	const Pair      pair   = deep.make(Real(0.3), kind, random);
	const Real      radius = pair.shape[0]->cornerRadius(), size = pair.size();
	const Vector3   direction = query(pair).normal;
	const auto      at        = [&](Real way) { return query(movedApart(pair, -way * direction)); };
	const int       steps     = 400;
	Real            before    = 0;
	ContactResult   last      = at(0);
	for (int step = 1; step <= steps; ++step) {
		const Real    way  = 4 * radius * step / steps;
		ContactResult here = at(way);
		if (here.status != last.status) {
			Real low = before, high = way;
			for (int k = 0; k < 60; ++k) {
				const Real middle                               = (low + high) / 2;
				(at(middle).status == last.status ? low : high) = middle;
			}
			const ContactResult one = at(low), two = at(high);
			std::cout << '"' << kind << "\"," << number << ',' << statusName(one.status) << ',' << statusName(two.status) << ','
			          << -two.infeasibility / radius << ',' << (one.normal - two.normal).norm() << ','
			          << std::abs(one.depth - two.depth) / two.depth << ',' << (one.point - two.point).norm() / size << '\n';
		}
		before = way;
		last   = here;
	}
}

int transitions(int samples)
{
	std::cout << "kind,sample,from,to,overlap,normal,depth,point\n";
	for (const PairAxis& axis : pairAxes())
		if (axis.name == "deep")
			for (const std::string& kind : axis.kinds)
				for (int number = 0; number < samples; ++number)
					pressIn(axis, kind, number);
	return 0;
}

int usage(const char* program)
{
	std::cerr << "usage: " << program << " [--quick] SAMPLES [AXIS …], or --transitions SAMPLES; axes:";
	for (const PairAxis& axis : pairAxes())
		std::cerr << ' ' << axis.name;
	std::cerr << '\n';
	return 2;
}

} // namespace

int main(int count, char** arguments)
{
	std::cout.precision(17);
	const bool quick   = count > 1 && !std::strcmp(arguments[1], "--quick");
	const int  first   = quick ? 2 : 1;
	const int  samples = count > first ? std::atoi(arguments[first]) : 0;
	if (count == 3 && !std::strcmp(arguments[1], "--transitions")) return transitions(std::atoi(arguments[2]));
	if (samples < 1) return usage(arguments[0]);
	for (int i = first + 1; i < count; ++i) {
		bool known = false;
		for (const PairAxis& axis : pairAxes())
			known = known || axis.name == arguments[i];
		if (!known) return usage(arguments[0]);
	}
	std::cout << "axis,kind,value,sample,status,inContact,touches,within,size,inscribed,infeasibility,infeasibilityError,"
	             "infeasibilityRounding,"
	             "depth,depthError,depthRounding,centreError,centreRounding,normalError,normalRounding,forceError,"
	             "compared,finite,bounded,free,"
	             "deviation,moved,pivots,iterations,nanoseconds,refusal\n";
	for (const PairAxis& axis : pairAxes()) {
		bool asked = count == first + 1;
		for (int i = first + 1; i < count; ++i)
			asked = asked || axis.name == arguments[i];
		if (!asked) continue;
		for (const std::string& kind : axis.kinds)
			for (Real value : axis.values) {
				const bool costly = value > axis.costlyAbove;
				for (int number = 0;
				        number < samples && !(costly && (quick || number * value > samples * axis.costlyAbove)); ++number)
					sample(axis, value, kind, number);
			}
	}
}
