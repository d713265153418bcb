// SPDX-License-Identifier: GPL-2.0-or-later
//
// Random pairs against exact arithmetic. Prints a table, a record for each defect, and ends with 1 if there is any.
#include "Walk.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iterator>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <unistd.h>

using namespace polytope;
using namespace polytope::search;

namespace {

struct Options {
	long          pairs   = 1000000;
	unsigned long seed    = 1;
	unsigned      threads = 0;  ///< 0: as many as the machine has
	int           family  = -1; ///< -1: all
	long          trial   = -1; ///< -1: as many as there are pairs for
	std::string   log;
};

const char* usage
        = "./run search [--quick] [--pairs N] [--seed S] [--threads T] [--family NAME [--trial K]] [--log FILE]\n"
          "Compares random pairs with exact arithmetic; ends with 1 if there is a defect.\n"
          "  --quick    250 000 pairs: a minute\n"
          "  --pairs    how many pairs (10^6), up to whole trials of each family; what is found depends on this and the seed\n"
          "  --seed     of the random numbers (1)\n"
          "  --threads  how many (0: as many as the machine has)\n"
          "  --family   this family alone\n"
          "  --trial    one trial of the family alone, as the record of a defect names it; any whole number is a trial of its own,\n"
          "             a search takes those from 0 on, as many as --pairs is enough for\n"
          "  --log      also writes the table to this file (./run search: one in output/search)\n"
          "  --help     shows this\n"
          "Families:";

std::string familyNames()
{
	std::string names;
	for (const Family& family : families())
		names += std::string(" ") + family.name;
	return names;
}

[[noreturn]] void refuse(const std::string& why)
{
	std::fprintf(stderr, "%s\n./run search --help lists the options.\n", why.c_str());
	std::exit(2);
}

/// Months of computing: a larger number is assumed to be a typing error.
constexpr long mostPairs  = 1000000000000;
constexpr long quickPairs = 250000; // as the tests

long numberOf(const std::string& name, const char* value, long least, long most)
{
	char* end         = nullptr;
	errno             = 0;
	const long number = std::strtol(value, &end, 10);
	if (*end || end == value || errno || number < least || number > most)
		refuse(name + ": must be a whole number from " + std::to_string(least) + " to " + std::to_string(most) + ", not '" + value
		        + "'");
	return number;
}

Options optionsOf(int count, char** arguments)
{
	Options     options;
	const char* pairs = nullptr; ///< the option that says how many
	for (int i = 1; i < count; ++i) {
		const std::string name = arguments[i];
		if (name == "--help" || name == "-h") {
			std::printf("%s%s\n", usage, familyNames().c_str());
			std::exit(0);
		}
		if (name == "--quick") {
			options.pairs = quickPairs;
			pairs         = "--quick";
			continue;
		}
		const char* known[] = { "--pairs", "--seed", "--threads", "--trial", "--log", "--family" };
		if (std::find(std::begin(known), std::end(known), name) == std::end(known)) refuse("there is no option " + name);
		if (++i == count) refuse(name + ": give a value");
		const char* value = arguments[i];
		if (name == "--pairs") {
			options.pairs = numberOf(name, value, 1, mostPairs);
			pairs         = "--pairs";
		} else if (name == "--seed") options.seed = (unsigned long)(numberOf(name, value, 0, LONG_MAX));
		else if (name == "--threads") options.threads = unsigned(numberOf(name, value, 0, 1024));
		else if (name == "--trial") options.trial = numberOf(name, value, 0, mostPairs);
		else if (name == "--log") options.log = value;
		else if (name == "--family") {
			for (std::size_t f = 0; f < families().size(); ++f)
				if (families()[f].name == std::string(value)) options.family = int(f);
			if (options.family < 0) refuse("--family: there is no '" + std::string(value) + "', but" + familyNames());
		}
	}
	if (options.trial >= 0 && options.family < 0) refuse("--trial: name its --family");
	if (options.trial >= 0 && pairs)
		refuse(std::string(pairs) + ": not with --trial, which is " + std::to_string(posesPerTrial) + " pairs");
	return options;
}

std::string cannotWrite(const std::string& path) { return "--log: cannot write to " + path + ": " + std::strerror(errno); }

/// Checks that the log can be written, before the search, which may take hours. What the file holds stays until then.
void checkLog(const std::string& path)
{
	std::FILE* file = std::fopen(path.c_str(), "a");
	if (!file) refuse(cannotWrite(path) + "; name a file in a folder that is there");
	std::fclose(file);
}

/// Runs all trials, distributed to the threads one by one; each has its own random numbers.
void run(const Options& options, std::vector<Tally>& tallies, std::vector<Finding>& findings)
{
	const long        first     = options.family < 0 ? 0 : options.family;
	const long        chosen    = options.family < 0 ? long(families().size()) : 1;
	const long        perFamily = (options.pairs + chosen * posesPerTrial - 1) / (chosen * posesPerTrial);
	const long        total     = options.trial >= 0 ? 1 : perFamily * chosen;
	std::mutex        mutex;
	std::atomic<long> next { 0 };
	const bool        shown = isatty(STDERR_FILENO);
	const auto        work  = [&] {
                std::vector<Tally>   own(families().size());
                std::vector<Finding> found;
                for (long i = next++; i < total; i = next++) {
                        const int family = int(first + i % chosen);
                        walk(family, options.trial >= 0 ? options.trial : i / chosen, options.seed, own[std::size_t(family)], found);
                        if (shown && i % (total / 200 + 1) == 0) std::fprintf(stderr, "\r%3ld %%", 100 * i / total);
                }
                const std::lock_guard<std::mutex> lock(mutex);
                for (std::size_t f = 0; f < own.size(); ++f)
                        tallies[f].add(own[f]);
                findings.insert(findings.end(), found.begin(), found.end());
	};
	std::vector<std::thread> threads;
	const unsigned           count = options.threads ? options.threads : std::max(1u, std::thread::hardware_concurrency());
	for (unsigned t = 1; t < count; ++t)
		threads.emplace_back(work);
	work();
	for (std::thread& thread : threads)
		thread.join();
	if (shown) std::fprintf(stderr, "\r      \r");
	std::sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
		return std::tie(a.family, a.trial, a.pose, a.defect, a.text) < std::tie(b.family, b.trial, b.pose, b.defect, b.text);
	});
}

std::string line(const char* name, const Tally& t)
{
	char text[300];
	long defects = 0;
	for (long count : t.defects)
		defects += count;
	std::snprintf(text, sizeof text, "%-19s %9ld %9ld %9ld %7ld %7ld %10ld %6.1f %8ld %7.2f %6.2f %7.2f %6d %10d %7ld\n", name, t.pairs,
	        t.overlaps, t.gaps, t.undecided, t.exact, t.queries, double(t.worstInfeasibility), t.compared, double(t.worstEnergy),
	        double(t.worstForce), double(t.worstMoment), t.mostPivots, t.mostIterations, defects);
	return text;
}

std::string report(const Options& options, const std::vector<Tally>& tallies, const std::vector<Finding>& findings, double seconds)
{
	std::ostringstream out;
	const char*        revision = std::getenv("POLYTOPE_REVISION");
	const std::time_t  now      = std::time(nullptr);
	char               date[40];
	std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
	out << "Random pairs against exact arithmetic, " << date << "\n";
	out << "revision " << (revision ? revision : "unknown") << "; " << POLYTOPE_COMPILER << "; " << instructionSet() << "\n";
	if (options.trial < 0) out << "--pairs " << options.pairs << " ";
	out << "--seed " << options.seed;
	if (options.family >= 0) out << " --family " << families()[std::size_t(options.family)].name;
	if (options.trial >= 0) out << " --trial " << options.trial;
	out << "; " << posesPerTrial << " pairs a trial\n\n";
	out << "family                  pairs   overlap     apart  border   exact    queries  error compared  volume  force  moment pivots "
	       "iterations defects\n";
	Tally all;
	for (std::size_t f = 0; f < tallies.size(); ++f) {
		if (tallies[f].pairs || options.family == int(f)) out << line(families()[f].name, tallies[f]);
		all.add(tallies[f]);
	}
	out << line("all", all);
	out << "\noverlap, apart: by more than the contact tolerance and rounding; border: between, where either answer will do.\n"
	       "exact: bounds in long double did not decide, rational arithmetic did. error: largest of s*, in roundings of the pair's "
	       "reach\n"
	       "(8 are allowed). pivots, iterations: most of one query.\n"
	       "compared: pairs whose energy, force and moment as foundation and as spring, cold, warm and exchanged, were compared with\n"
	       "113-digit arithmetic; volume, force, moment: largest errors, over what is allowed. They are one of "
	    << overlapsPerExact << " that overlap, drawn,\nand all whose answers were not alike within rounding, " << all.unlike
	    << ". Of all compared, " << all.ridges
	    << " have planes of both bodies that\nnearly coincide: rounding of a plane moves the force more than ten times as far as "
	       "without,\nand as much more is allowed.\n\n";
	for (int m = 0; m < modelCount; ++m) {
		out << modelName(models[m]) << ":";
		for (int s = 0; s < contactStatusCount; ++s) {
			const long count = all.statuses[std::size_t(m)][std::size_t(s)];
			if (count) out << ' ' << statusName(ContactStatus(s)) << ' ' << count;
		}
		out << "\n";
	}
	out << "defects:";
	for (int d = 0; d < defectCount; ++d)
		out << ' ' << defectName(Defect(d)) << ' ' << all.defects[std::size_t(d)] << (d + 1 < defectCount ? "," : "\n");
	if (!findings.empty()) out << "\nRecords (again: --seed " << options.seed << " --family FAMILY --trial TRIAL):\n";
	for (std::size_t i = 0; i < findings.size() && i < 200; ++i) {
		const Finding& f = findings[i];
		out << families()[std::size_t(f.family)].name << ' ' << f.trial << " (pose " << f.pose << "), " << defectName(f.defect)
		    << ", " << f.text << "\n";
	}
	if (findings.size() > 200) out << "… and " << findings.size() - 200 << " more\n";
	out << "\n" << long(seconds) << " s, " << (options.threads ? options.threads : std::thread::hardware_concurrency()) << " threads\n";
	return out.str();
}

} // namespace

int main(int count, char** arguments)
{
	const Options options = optionsOf(count, arguments);
	if (!options.log.empty()) checkLog(options.log);
	std::vector<Tally>   tallies(families().size());
	std::vector<Finding> findings;
	const auto           started = std::chrono::steady_clock::now();
	run(options, tallies, findings);
	const std::string text
	        = report(options, tallies, findings, std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
	std::fputs(text.c_str(), stdout);
	if (!options.log.empty()) {
		std::FILE* file = std::fopen(options.log.c_str(), "w");
		if (!file || std::fputs(text.c_str(), file) < 0 || std::fclose(file)) {
			std::fprintf(stderr, "%s\n", cannotWrite(options.log).c_str());
			return 2;
		}
	}
	return findings.empty() ? 0 : 1;
}
