// SPDX-License-Identifier: GPL-2.0-or-later
#include "Walk.hpp"

#include "Certificate.hpp"

#include <cstdarg>
#include <cstdio>
#include <stdexcept>

namespace polytope::search {

using namespace samples;

namespace {

	std::string text(const char* format, ...)
	{
		char    line[300];
		va_list values;
		va_start(values, format);
		std::vsnprintf(line, sizeof line, format, values);
		va_end(values);
		return line;
	}

	bool finite(const ContactResult& r)
	{
		return r.point.allFinite() && r.normal.allFinite() && r.sectionCentroid.allFinite() && r.dualDirection.allFinite()
		        && std::isfinite(r.depth) && std::isfinite(r.infeasibility) && std::isfinite(r.area) && std::isfinite(r.energy)
		        && std::isfinite(r.turningArm);
	}

	/// The queries made for one pose.
	class Examiner {
	public:
		Examiner(int family, long trial, Tally& tally, std::vector<Finding>& findings)
		        : family_(family), trial_(trial), tally_(tally), findings_(findings)
		{
		}

		/// Begins with the poses of one moving pair: chooses the settings of all of them and clears the memory.
		void start(Random& random)
		{
			paper_                   = ContactSettings();
			paper_.geometryAcrossGap = random() % 4 == 0;
			paper_.section           = random() % 4 == 0;
			spring_                  = paper_;
			spring_.contactModel     = ContactModel::Spring;
			for (PairMemory& memory : memory_)
				memory = PairMemory();
		}

		void examine(const Pair& pair, int pose)
		{
			pose_ = pose;
			++tally_.pairs;
			ContactSettings lp;
			lp.tolerance               = -1e6; // no dismissal
			lp.contactPoint            = ContactPoint::ChebyshevCentre;
			const ContactResult solved = query(pair, lp);
			++tally_.queries;
			Certificate certificate(pair);
			const Real  allowed = allowedError(pair);
			certificate.bracket(solved);
			const auto error = [&] {
				return Real(std::max(certificate.upper - solved.infeasibility, solved.infeasibility - certificate.lower));
			};
			if (!(certificate.upper - certificate.lower <= allowed / 4 && error() <= allowed)) {
				certificate.solveExactly();
				++tally_.exact;
			}
			const Real off            = error();
			tally_.worstInfeasibility = std::max(tally_.worstInfeasibility, off / (tolerance::rounding * pair.reach()));
			if (!(off <= allowed))
				report(Defect::Infeasibility, "LP",
				        text("s* %.17g instead of %.17Lg, size %g", solved.infeasibility, certificate.upper, pair.size()));
			if (gaveUp(pair, certificate, solved.status)) report(Defect::NotConverged, "LP", statusName(solved.status));
			tally_.mostPivots = std::max(tally_.mostPivots, solved.simplexPivots);
			const Real level  = -tolerance::contact * pair.size();
			if (certificate.upper < level - allowed) ++tally_.overlaps;
			else if (certificate.lower > level + allowed) ++tally_.gaps;
			else ++tally_.undecided;

			PairMemory cold[4];
			checkPaper(pair, certificate, query(pair, paper_, &cold[0]), "cold");
			checkPaper(pair, certificate, query(pair, paper_, &memory_[0]), "warm");
			checkSpring(pair, certificate, query(pair, spring_, &cold[1]), "spring, cold");
			checkSpring(pair, certificate, query(pair, spring_, &memory_[1]), "spring, warm");
			const Pair  other = swapped(pair);
			Certificate exchanged(other);
			exchanged.lower = certificate.lower;
			exchanged.upper = certificate.upper;
			checkPaper(other, exchanged, query(other, paper_, &cold[2]), "exchanged");
			checkSpring(other, exchanged, query(other, spring_, &cold[3]), "spring, exchanged");
		}

		void report(Defect defect, const char* way, const std::string& what)
		{
			++tally_.defects[std::size_t(defect)];
			if (findings_.size() < 1000)
				findings_.push_back({ family_, trial_, pose_, defect, std::string(way) + ": " + what });
		}

	private:
		int                   family_;
		long                  trial_;
		int                   pose_ = -1;
		Tally&                tally_;
		std::vector<Finding>& findings_;
		ContactSettings       paper_, spring_;
		PairMemory            memory_[2];

		/// No answer, or one that Newton's method did not find. That no direction separates the bodies is an answer where it is
		/// proved: s* is then that of one body alone.
		static bool gaveUp(const Pair& pair, const Certificate& certificate, ContactStatus status)
		{
			if (status == ContactStatus::NoDirection)
				return std::abs(certificate.upper + pair.inscribedRadius()) > 2 * allowedError(pair);
			return !answered(status) || status == ContactStatus::CentreByIpopt;
		}

		/// Checks that both models must pass. `mayCancel`: pressures of a contact surface may, where one body is in the other or pierces it.
		void checkAnswer(
		        const Pair& pair, const Certificate& certificate, const ContactResult& result, const char* way, bool mayCancel)
		{
			++tally_.queries;
			const Real allowed   = allowedError(pair);
			const bool cancelled = mayCancel && result.status == ContactStatus::NoDirection;
			if (!cancelled && gaveUp(pair, certificate, result.status))
				report(Defect::NotConverged, way, statusName(result.status));
			if (!finite(result)) report(Defect::NotFinite, way, "a number is none");
			if (result.hasGeometry && !(std::abs(result.normal.norm() - 1) <= 1e-14))
				report(Defect::NotFinite, way, text("normal of length 1 + %g", result.normal.norm() - 1));
			if (result.inContact && !(result.depth >= 0 && result.area >= 0))
				report(Defect::NotFinite, way, text("depth %g, area %g", result.depth, result.area));
			// a pair that was dismissed has a bound, no more
			const bool bound = !result.hasGeometry;
			if (result.infeasibility > certificate.upper + allowed
			        || (!bound && result.infeasibility < certificate.lower - allowed))
				report(Defect::Infeasibility, way,
				        text("s* %.17g instead of %.17Lg, size %g", result.infeasibility, certificate.upper, pair.size()));
			tally_.mostPivots       = std::max(tally_.mostPivots, result.simplexPivots);
			tally_.mostIterations   = std::max(tally_.mostIterations, result.newtonIterations);
			const Real        level = -paper_.tolerance * pair.size();
			const std::string s     = described(pair, certificate, result);
			if (!result.inContact && certificate.upper < level - allowed) report(Defect::Miss, way, s);
			if (result.inContact && certificate.lower > level + allowed) report(Defect::FalseContact, way, s);
		}

		static std::string described(const Pair& pair, const Certificate& certificate, const ContactResult& result)
		{
			return text("%s, s* %.6Lg (here %.6g), size %g", statusName(result.status), certificate.upper, result.infeasibility,
			        pair.size());
		}

		void checkPaper(const Pair& pair, const Certificate& certificate, const ContactResult& result, const char* way)
		{
			checkAnswer(pair, certificate, result, way, false);
			++tally_.paper[std::size_t(result.status)];
			const Real        allowed = allowedError(pair);
			const std::string s       = described(pair, certificate, result);
			if (!result.inContact || (!answered(result.status) && result.status != ContactStatus::NoDirection))
				return; // reported
			// the point's own rounding and the planes', over the overlap's thickness
			const Real loose = 2e-9 + 4 * Real(allowed / -certificate.upper);
			if (!(loose > 0 && loose < 0.1)) return;
			const Extended decrement = certificate.centreDecrement(result.point);
			if (!(decrement <= loose)) report(Defect::Centre, way, s + text(", decrement %Lg instead of %g", decrement, loose));
		}

		void checkSpring(const Pair& pair, const Certificate& certificate, const ContactResult& result, const char* way)
		{
			checkAnswer(pair, certificate, result, way, true);
			++tally_.spring[std::size_t(result.status)];
			if (result.inContact && !(result.energy > 0)) report(Defect::NoEnergy, way, described(pair, certificate, result));
		}
	};

	/// A step: both bodies a little, now and then back to some s* along the dual direction.
	void step(Pair& pair, Real stride, Random& random)
	{
		const int D = pair.dimension();
		pair.centre2 += stride * pair.inscribedRadius() * randomDirection(random, D);
		for (Matrix3& rotation : pair.rotation) {
			const Vector3 axis = D == 2 ? Vector3(0, 0, 1) : randomDirection(random);
			rotation           = Eigen::AngleAxis<Real>(uniform(random, -stride, stride), axis).toRotationMatrix() * rotation;
		}
		if (random() % 2) return;
		const ContactResult result = linearProgram(pair);
		const Real          length = result.dualDirection.norm();
		if (length > 0.05)
			pair.centre2 += (someInfeasibility(pair, random) - result.infeasibility) / (length * length) * result.dualDirection;
	}

} // namespace

const char* defectName(Defect defect)
{
	switch (defect) {
		case Defect::Miss: return "miss";
		case Defect::FalseContact: return "false contact";
		case Defect::Infeasibility: return "wrong s*";
		case Defect::Centre: return "unreported centre";
		case Defect::NotConverged: return "not converged";
		case Defect::NotFinite: return "not finite";
		case Defect::NoEnergy: return "no energy";
		case Defect::Shape: return "shape";
	}
	return "unknown";
}

void Tally::add(const Tally& other)
{
	pairs += other.pairs;
	overlaps += other.overlaps;
	gaps += other.gaps;
	queries += other.queries;
	exact += other.exact;
	undecided += other.undecided;
	for (std::size_t i = 0; i < paper.size(); ++i) {
		paper[i] += other.paper[i];
		spring[i] += other.spring[i];
	}
	for (std::size_t i = 0; i < defects.size(); ++i)
		defects[i] += other.defects[i];
	worstInfeasibility = std::max(worstInfeasibility, other.worstInfeasibility);
	mostPivots         = std::max(mostPivots, other.mostPivots);
	mostIterations     = std::max(mostIterations, other.mostIterations);
}

void walk(int family, long trial, unsigned long seed, Tally& tally, std::vector<Finding>& findings)
{
	std::seed_seq sequence { unsigned(seed), unsigned(seed >> 32), unsigned(family), unsigned(trial), unsigned(trial >> 32) };
	Random        random(sequence);
	Examiner      examiner(family, trial, tally, findings);
	try {
		const Poses scene = families()[std::size_t(family)].scene(random);
		for (int pose = 0; pose < posesPerTrial;) {
			Pair pair = scene(random);
			examiner.start(random);
			const Real stride = decades(random, -9, Real(-0.5));
			for (const int end = pose + 1 + int(random() % 8); pose < end && pose < posesPerTrial; ++pose) {
				examiner.examine(pair, pose);
				step(pair, stride, random);
			}
		}
	} catch (const std::exception& error) {
		examiner.report(Defect::Shape, "construction", error.what());
	}
}

} // namespace polytope::search
