// SPDX-License-Identifier: GPL-2.0-or-later
#include "Walk.hpp"

#include "Certificate.hpp"
#include "ExactSurface.hpp"

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
			settings_                   = ContactSettings();
			settings_.geometryAcrossGap = random() % 4 == 0;
			settings_.section           = random() % 4 == 0;
			for (PairMemory& memory : memory_)
				memory = PairMemory();
		}

		void examine(const Pair& pair, int pose, Random& random)
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

			const Pair  other = swapped(pair);
			Certificate exchanged(other);
			exchanged.lower = certificate.lower;
			exchanged.upper = certificate.upper;
			std::vector<Answer> answers;
			for (int m = 0; m < modelCount; ++m) {
				settings_.contactModel = models[m];
				PairMemory          cold, ofOther;
				const ContactResult results[] = { query(pair, settings_, &cold), query(pair, settings_, &memory_[m]),
					query(other, settings_, &ofOther) };
				for (const Way way : { Way::Cold, Way::Warm, Way::Exchanged }) {
					const bool           turned = way == Way::Exchanged;
					const ContactResult& result = results[int(way)];
					check(turned ? other : pair, turned ? exchanged : certificate, result, { models[m], way });
					if (!hasSurface(models[m]) || !result.inContact) continue;
					const Vector3 about = turned ? Vector3(solved.point - pair.centre2) : solved.point;
					answers.push_back({ models[m], way, ContactLoad(result, models[m], ClosureLaw(), about),
					        result.status != ContactStatus::NoDirection });
					if (!turned) continue;
					answers.back().load.force *= -1;
					answers.back().load.moment *= -1;
				}
			}
			checkLoads(pair, solved.point, -Real(certificate.upper), answers, random());
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
		ContactSettings       settings_;
		PairMemory            memory_[modelCount];

		enum class Way : int { Cold, Warm, Exchanged };

		struct Question {
			ContactModel model;
			Way          way;

			std::string name() const
			{
				const char* const ways[] = { "cold", "warm", "exchanged" };
				return std::string(modelName(model)) + ", " + ways[int(way)];
			}
		};

		/// An answer of a model with a surface, as that of the pair itself, about the program's point.
		struct Answer : Question {
			ContactLoad load;
			bool        directed; ///< else pressures cancel, and of their moment a contact has none

			Answer(ContactModel model, Way way, const ContactLoad& load_, bool directed_)
			        : Question { model, way }, load(load_), directed(directed_)
			{
			}
		};

		struct Errors {
			Real energy, force, moment;

			Errors(const Answer& answer, const LoadWithUnits& right)
			        : energy(std::abs(answer.load.energy - right.load.energy) / right.energyUnit),
			          force((answer.load.force - right.load.force).norm() / right.forceUnit),
			          moment(answer.directed ? (answer.load.moment - right.load.moment).norm() / right.momentUnit : 0)
			{
			}
			bool within(Real most) const { return energy <= most && force <= most && moment <= most; }
		};

		/// Compares answers with each other, and with the exact surface if this pair is drawn, by its `number`, or the answers are not alike.
		void checkLoads(
		        const Pair& pair, const Vector3& origin, Real deepest, const std::vector<Answer>& answers, std::uint64_t number)
		{
			if (answers.empty() || !(deepest > 0) || !(roundingOf(pair, deepest) <= coarsestRounding)) return;
			bool alike = true;
			for (std::size_t i = 1; i < answers.size(); ++i) {
				const Answer &one = answers[i - 1], &other = answers[i];
				if (one.model != other.model) continue;
				alike = alike && Errors(other, LoadWithUnits(one.load, pair, deepest)).within(allowedUnits(one.model));
			}
			if (number % overlapsPerExact != 0 && alike) return;
			Random random(number);
			++tally_.compared;
			tally_.unlike += !alike;
			ExactSurface exact(pair, origin, deepest);
			const auto   right = [&](const Answer& a) { return Errors(a, exact.of(a.model)).within(allowedUnits(a.model)); };
			// what rounding may do is found from a few draws, and, before an answer counts as wrong, from many
			for (int draw = 0; draw < 2 || (draw < 30 && !std::all_of(answers.begin(), answers.end(), right)); ++draw)
				exact.drawErrors(random);
			tally_.ridges += exact.hasRidge();
			for (const Answer& answer : answers) {
				const LoadWithUnits& own = exact.of(answer.model);
				const Errors         errors(answer, own);
				const Real           most = allowedUnits(answer.model);
				const auto           held = [&](Defect defect, Real error, Real& worst, Real unit, Real whole) {
                                        worst = std::max(worst, error / most);
                                        if (error <= most) return;
                                        report(defect, answer.name().c_str(),
					                  text("off by %g of %g, where %g is allowed, s* %g, size %g", error * unit, whole,
					                          most * unit, -deepest, pair.size()));
				};
				held(Defect::Energy, errors.energy, tally_.worstEnergy, own.energyUnit, own.load.energy);
				held(Defect::Force, errors.force, tally_.worstForce, own.forceUnit, own.load.force.norm());
				held(Defect::Moment, errors.moment, tally_.worstMoment, own.momentUnit, own.load.moment.norm());
			}
		}

		/// No answer, or one that Newton's method did not find. That no direction separates the bodies is an answer where it is
		/// proved: s* is then that of one body alone.
		static bool gaveUp(const Pair& pair, const Certificate& certificate, ContactStatus status)
		{
			if (status == ContactStatus::NoDirection)
				return std::abs(certificate.upper + pair.inscribedRadius()) > 2 * allowedError(pair);
			return !answered(status) || status == ContactStatus::CentreByIpopt;
		}

		void check(const Pair& pair, const Certificate& certificate, const ContactResult& result, const Question& question)
		{
			++tally_.queries;
			++tally_.statuses[std::size_t(std::find(models, models + modelCount, question.model) - models)]
			                 [std::size_t(result.status)];
			const std::string name    = question.name();
			const char* const way     = name.c_str();
			const Real        allowed = allowedError(pair);
			// pressures of a contact surface may cancel, where one body is in the other or pierces it
			const bool cancelled = hasSurface(question.model) && result.status == ContactStatus::NoDirection;
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
			const Real        level = -settings_.tolerance * pair.size();
			const std::string s     = described(pair, certificate, result);
			if (!result.inContact && certificate.upper < level - allowed) report(Defect::Miss, way, s);
			if (result.inContact && certificate.lower > level + allowed) report(Defect::FalseContact, way, s);
			if (!hasSurface(question.model)) checkCentre(pair, certificate, result, way);
			else if (result.inContact && !(result.energy > 0)) report(Defect::NoEnergy, way, s);
		}

		static std::string described(const Pair& pair, const Certificate& certificate, const ContactResult& result)
		{
			return text("%s, s* %.6Lg (here %.6g), size %g", statusName(result.status), certificate.upper, result.infeasibility,
			        pair.size());
		}

		void checkCentre(const Pair& pair, const Certificate& certificate, const ContactResult& result, const char* way)
		{
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
		case Defect::Energy: return "wrong volume";
		case Defect::Force: return "wrong force";
		case Defect::Moment: return "wrong moment";
		case Defect::Shape: return "shape";
	}
	return "unknown";
}

const char* modelName(ContactModel model)
{
	return model == ContactModel::Boon2012 ? "boon2012" : model == ContactModel::Foundation ? "foundation" : "spring";
}

void Tally::add(const Tally& other)
{
	pairs += other.pairs;
	overlaps += other.overlaps;
	gaps += other.gaps;
	queries += other.queries;
	exact += other.exact;
	undecided += other.undecided;
	compared += other.compared;
	unlike += other.unlike;
	ridges += other.ridges;
	for (std::size_t m = 0; m < statuses.size(); ++m)
		for (std::size_t i = 0; i < statuses[m].size(); ++i)
			statuses[m][i] += other.statuses[m][i];
	for (std::size_t i = 0; i < defects.size(); ++i)
		defects[i] += other.defects[i];
	worstInfeasibility = std::max(worstInfeasibility, other.worstInfeasibility);
	worstEnergy        = std::max(worstEnergy, other.worstEnergy);
	worstForce         = std::max(worstForce, other.worstForce);
	worstMoment        = std::max(worstMoment, other.worstMoment);
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
				examiner.examine(pair, pose, random);
				step(pair, stride, random);
			}
		}
	} catch (const std::exception& error) {
		examiner.report(Defect::Shape, "construction", error.what());
	}
}

} // namespace polytope::search
