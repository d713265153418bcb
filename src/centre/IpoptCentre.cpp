// SPDX-License-Identifier: GPL-2.0-or-later
#include "centre/IpoptCentre.hpp"

#include "centre/IpoptLinearSolver.hpp"
#include "centre/IpoptProgram.hpp"
#include "numbers/Tolerances.hpp"

#include <IpAlgBuilder.hpp>
#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpStdAugSystemSolver.hpp>
#include <IpTNLPAdapter.hpp>
#include <IpTSymLinearSolver.hpp>
#include <IpoptConfig.h>

#include <memory>
#include <mutex>

namespace polytope {

using namespace Ipopt;

namespace {

	/// Ipopt's objects, made once per thread and reused for every pair.
	class IpoptRunner {
	public:
		IpoptRunner();
		IpoptOutcome solve(int dimension, int count, const Real* const* normal, const Real* offset, Real* x, int& iterations);

	private:
		ApplicationReturnStatus optimise();

		SmartPtr<IpoptProgram>      program_ = new IpoptProgram;
		SmartPtr<IpoptLinearSolver> linear_  = new IpoptLinearSolver;
		SmartPtr<IpoptApplication>  application_;
		SmartPtr<NLP>               adapter_;
		bool                        algorithm_ = false; ///< made, and reusable
	};

	IpoptRunner::IpoptRunner()
	{
		application_ = new IpoptApplication(/*create_console_out*/ false);
		application_->RethrowNonIpoptException(true); // to be caught here rather than printed there
		OptionsList& options = *application_->Options();
		options.SetIntegerValue("print_level", 0);
		options.SetStringValue("sb", "yes");
		options.SetStringValue("linear_solver", "custom");
		options.SetStringValue("nlp_scaling_method", "none"); // it is scaled
		options.SetStringValue("jac_c_constant", "yes");
		options.SetNumericValue("bound_relax_factor", 0);
		options.SetNumericValue("tol", tolerance::ipopt);
		options.SetIntegerValue("max_iter", tolerance::ipoptIterations);
		options.SetIntegerValue("acceptable_iter", 3); // rounding keeps a badly scaled round above `tol`: take the next
		// Ipopt's barrier −μ Σ log σ_i for the bounds is a multiple of the objective and does not move the solution: no need
		// to let μ go to zero, unless a damping term were added to it
		options.SetNumericValue("mu_init", 1);
		options.SetNumericValue("mu_target", 1);
		options.SetNumericValue("kappa_d", 0);
		if (application_->Initialize("") != Solve_Succeeded) application_ = nullptr; // "": no file of options is read
	}

	ApplicationReturnStatus IpoptRunner::optimise()
	{
		if (algorithm_) return application_->ReOptimizeNLP(adapter_);
		SmartPtr<SymLinearSolver>  linear  = new TSymLinearSolver(GetRawPtr(linear_), nullptr);
		SmartPtr<AlgorithmBuilder> builder = new AlgorithmBuilder(new StdAugSystemSolver(*linear), "block elimination");
		adapter_                           = new TNLPAdapter(GetRawPtr(program_), ConstPtr(application_->Jnlst()));
		algorithm_                         = true;
		return application_->OptimizeNLP(adapter_, builder);
	}

	IpoptOutcome IpoptRunner::solve(int dimension, int count, const Real* const* normal, const Real* offset, Real* x, int& iterations)
	{
		if (!IsValid(application_)) return IpoptOutcome::Failed;
		linear_->setDimension(dimension);
		program_->start(dimension, count, normal, offset, x);
		if (program_->inside()) program_->moveToMiddle();
		// A round ends where Ipopt's tolerance, rounding or the limit of iterations ends it. Each starts from the last one's
		// point with a scaling of its own, until one needs no iteration: then its numbers were about one.
		for (int round = 0; round < tolerance::ipoptRounds; ++round) {
			program_->scale();
			const ApplicationReturnStatus status = optimise();
			if (IsValid(application_->Statistics())) iterations += application_->Statistics()->IterationCount();
			const Real moved  = program_->moveToSolution();
			const bool inside = program_->inside();
			if (!(moved >= 0) || (!inside && status != Maximum_Iterations_Exceeded)) return IpoptOutcome::Failed;
			if (inside && status == Solve_Succeeded && moved <= tolerance::ipoptMove) {
				for (int k = 0; k < dimension; ++k)
					x[k] = program_->point()[k];
				return IpoptOutcome::Converged;
			}
		}
		return IpoptOutcome::Failed;
	}

} // namespace

const char* ipoptVersion() { return IPOPT_VERSION; }

IpoptOutcome ipoptCentre(int dimension, int count, const Real* const* normal, const Real* offset, Real* x, int& iterations)
{
	static std::mutex                                making;
	static thread_local std::unique_ptr<IpoptRunner> solver;
	try {
		if (!solver) {
			const std::lock_guard<std::mutex> lock(making); // Ipopt registers its options in static data
			solver.reset(new IpoptRunner);
		}
		return solver->solve(dimension, count, normal, offset, x, iterations);
	} catch (...) { // Ipopt's own are no std::exception
		solver.reset();
		return IpoptOutcome::Failed;
	}
}

} // namespace polytope
