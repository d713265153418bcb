// SPDX-License-Identifier: GPL-2.0-or-later
#include "IpoptCentre.hpp"

#include "IpoptLinearSolver.hpp"
#include "Lanes.hpp"
#include "Tolerances.hpp"

#include <IpAlgBuilder.hpp>
#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpStdAugSystemSolver.hpp>
#include <IpTNLP.hpp>
#include <IpTNLPAdapter.hpp>
#include <IpTSymLinearSolver.hpp>
#include <IpoptConfig.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

namespace polytope {

using namespace Ipopt;

namespace {

	/// The programme. With x = x₀ + diag(D)·u and slacks in units of their own values at x₀, slack_i = S_i·σ_i:
	///
	///     minimise −Σ log σ_i   over u, σ      subject to   Σ_k (a_ik D_k/S_i) u_k + σ_i = b_i,   σ_i ≥ 0.
	///
	/// It starts at u = 0, σ = 1. Inside, all b_i are one and the constraints hold exactly, and every number in it is about
	/// one if x₀ is about in the middle of the overlap and D_k about half its width along axis k, however thin the overlap
	/// is. Outside, b_i is slack_i/S_i, down to −1: that slacks are unknowns of their own lets Ipopt start there, too.
	/// Unknowns: u (`dimension`), then σ (one a plane).
	class CentreProgramme : public TNLP {
	public:
		/// Slacks at x₀ = x.
		void start(int dimension, int count, const Real* const* normal, const Real* offset, const Real* x);

		/// Whether x₀ is strictly inside.
		bool inside() const;

		/// Moves x₀, inside, along one axis after the other to the middle of the chord, across the overlap's thin axis last.
		void moveToMiddle();

		/// Makes half the chords' lengths the axes' units, and writes the programme's coefficients.
		void scale();

		/// Moves x₀ to the solution. Gives how far that was, in the overlap's local norm at the old x₀: √Σ (a_i·step/S_i)²;
		/// negative if there is none.
		Real moveToSolution();

		const Real* point() const { return point_; }

		bool get_nlp_info(Index& n, Index& m, Index& nonZerosJacobian, Index& nonZerosHessian, IndexStyleEnum& style) override;
		bool get_bounds_info(
		        Index n, Number* lower, Number* upper, Index m, Number* constraintLower, Number* constraintUpper) override;
		bool get_starting_point(Index n, bool, Number* z, bool, Number*, Number*, Index, bool, Number*) override;
		bool eval_f(Index n, const Number* z, bool, Number& value) override;
		bool eval_grad_f(Index n, const Number* z, bool, Number* gradient) override;
		bool eval_g(Index, const Number* z, bool, Index m, Number* constraint) override;
		bool eval_jac_g(Index, const Number*, bool, Index m, Index, Index* rows, Index* columns, Number* values) override;
		bool eval_h(Index n, const Number* z, bool, Number factor, Index, const Number*, bool, Index, Index* rows, Index* columns,
		        Number* values) override;
		void finalize_solution(SolverReturn, Index n, const Number* z, const Number*, const Number*, Index, const Number*,
		        const Number*, Number, const IpoptData*, IpoptCalculatedQuantities*) override;

	private:
		/// From x₀ along an axis to the nearest planes.
		struct Chord {
			Real ahead, back;
		};
		Chord chord(const std::vector<Real>& slacks, int k) const;

		Real plane(int i, int k) const { return normal_[std::size_t(i) * dimension_ + k]; }

		int                 dimension_ = 0, planes_ = 0;
		Real                point_[3] = {};  ///< x₀
		Real                unit_[3]  = {};  ///< D
		std::vector<Real>   normal_, slack_; ///< a; d − a·x₀
		std::vector<Real>   slackUnit_;      ///< S
		std::vector<double> coefficient_;    ///< a_ik D_k/S_i
		std::vector<double> solution_;       ///< u, σ
	};

	void CentreProgramme::start(int dimension, int count, const Real* const* normal, const Real* offset, const Real* x)
	{
		dimension_ = dimension;
		normal_.clear();
		slack_.clear();
		for (int k = 0; k < dimension; ++k)
			point_[k] = x[k];
		for (int i = 0; i < count; ++i) {
			if (offset[i] >= Real(padOffset) / 2) continue;
			Real slack = offset[i];
			for (int k = 0; k < dimension; ++k) {
				normal_.push_back(normal[k][i]);
				slack -= normal[k][i] * x[k];
			}
			slack_.push_back(slack);
		}
		planes_ = int(slack_.size());
	}

	bool CentreProgramme::inside() const
	{
		return std::all_of(slack_.begin(), slack_.end(), [](const Real& slack) { return slack > 0; });
	}

	CentreProgramme::Chord CentreProgramme::chord(const std::vector<Real>& slacks, int k) const
	{
		Chord chord { padOffset, padOffset };
		for (int i = 0; i < planes_; ++i) {
			const Real rate = plane(i, k);
			if (rate > 0 && slacks[i] < chord.ahead * rate) chord.ahead = slacks[i] / rate;
			if (rate < 0 && slacks[i] < -chord.back * rate) chord.back = slacks[i] / -rate;
		}
		return chord;
	}

	void CentreProgramme::moveToMiddle()
	{
		for (int k = 0; k < dimension_; ++k) {
			const Chord c    = chord(slack_, k);
			const Real  move = (c.ahead - c.back) / 2;
			point_[k] += move;
			for (int i = 0; i < planes_; ++i)
				slack_[i] -= move * plane(i, k);
		}
	}

	void CentreProgramme::scale()
	{
		solution_.clear();
		// at a plane that passes through x₀: the length nearest to nothing that there is
		Real smallest = padOffset;
		for (const Real& slack : slack_)
			if (slack != 0) smallest = std::min<Real>(smallest, slack < 0 ? -slack : slack);
		slackUnit_.clear();
		for (const Real& slack : slack_)
			slackUnit_.push_back(std::max<Real>(smallest, slack < 0 ? -slack : slack));
		for (int k = 0; k < dimension_; ++k) {
			const Chord c = chord(slackUnit_, k);
			unit_[k]      = (c.ahead + c.back) / 2;
		}
		// from outside the way may be long against the slacks: no coefficient above one
		if (!inside())
			for (int i = 0; i < planes_; ++i)
				for (int k = 0; k < dimension_; ++k)
					slackUnit_[i]
					        = std::max<Real>(slackUnit_[i], (plane(i, k) < 0 ? -plane(i, k) : plane(i, k)) * unit_[k]);
		coefficient_.resize(normal_.size());
		for (int i = 0; i < planes_; ++i)
			for (int k = 0; k < dimension_; ++k)
				coefficient_[std::size_t(i) * dimension_ + k] = double(plane(i, k) * unit_[k] / slackUnit_[i]);
	}

	Real CentreProgramme::moveToSolution()
	{
		using std::sqrt;
		if (solution_.empty()) return -1; // Ipopt ended in an error
		Real step[3], sum = 0;
		for (int k = 0; k < dimension_; ++k) {
			step[k] = unit_[k] * solution_[k];
			point_[k] += step[k];
		}
		// from u, for σ holds to Ipopt's tolerance only
		for (int i = 0; i < planes_; ++i) {
			Real approach = 0;
			for (int k = 0; k < dimension_; ++k)
				approach += plane(i, k) * step[k];
			const Real relative = approach / slackUnit_[i];
			slack_[i] -= approach;
			sum += relative * relative;
		}
		return sqrt(sum);
	}

	bool CentreProgramme::get_nlp_info(Index& n, Index& m, Index& nonZerosJacobian, Index& nonZerosHessian, IndexStyleEnum& style)
	{
		n                = dimension_ + planes_;
		m                = planes_;
		nonZerosJacobian = planes_ * (dimension_ + 1);
		nonZerosHessian  = planes_;
		style            = C_STYLE;
		return true;
	}

	bool CentreProgramme::get_bounds_info(
	        Index n, Number* lower, Number* upper, Index m, Number* constraintLower, Number* constraintUpper)
	{
		constexpr Number infinite = 1e20; // beyond Ipopt's nlp_upper_bound_inf
		for (Index j = 0; j < n; ++j) {
			lower[j] = j < dimension_ ? -infinite : 0;
			upper[j] = infinite;
		}
		for (Index i = 0; i < m; ++i)
			constraintLower[i] = constraintUpper[i] = double(slack_[i] / slackUnit_[i]);
		return true;
	}

	bool CentreProgramme::get_starting_point(Index n, bool, Number* z, bool, Number*, Number*, Index, bool, Number*)
	{
		for (Index j = 0; j < n; ++j)
			z[j] = j < dimension_ ? 0 : 1;
		return true;
	}

	bool CentreProgramme::eval_f(Index n, const Number* z, bool, Number& value)
	{
		value = 0;
		for (Index j = dimension_; j < n; ++j) {
			if (!(z[j] > 0)) return false;
			value -= std::log(z[j]);
		}
		return true;
	}

	bool CentreProgramme::eval_grad_f(Index n, const Number* z, bool, Number* gradient)
	{
		for (Index j = 0; j < n; ++j)
			gradient[j] = j < dimension_ ? 0 : -1 / z[j];
		return true;
	}

	bool CentreProgramme::eval_g(Index, const Number* z, bool, Index m, Number* constraint)
	{
		for (Index i = 0; i < m; ++i) {
			constraint[i] = z[dimension_ + i];
			for (int k = 0; k < dimension_; ++k)
				constraint[i] += coefficient_[std::size_t(i) * dimension_ + k] * z[k];
		}
		return true;
	}

	bool CentreProgramme::eval_jac_g(Index, const Number*, bool, Index m, Index, Index* rows, Index* columns, Number* values)
	{
		Index next = 0;
		for (Index i = 0; i < m; ++i)
			for (int k = 0; k <= dimension_; ++k, ++next) {
				const bool sigma = k == dimension_;
				if (values) values[next] = sigma ? 1 : coefficient_[std::size_t(i) * dimension_ + k];
				else {
					rows[next]    = i;
					columns[next] = sigma ? dimension_ + i : k;
				}
			}
		return true;
	}

	bool CentreProgramme::eval_h(Index n, const Number* z, bool, Number factor, Index, const Number*, bool, Index, Index* rows,
	        Index* columns, Number* values)
	{
		// the constraints are linear: of the Lagrangian only the objective's own diagonal is left
		for (Index j = dimension_; j < n; ++j) {
			const Index i = j - dimension_;
			if (values) values[i] = factor / (z[j] * z[j]);
			else rows[i] = columns[i] = j;
		}
		return true;
	}

	void CentreProgramme::finalize_solution(SolverReturn, Index n, const Number* z, const Number*, const Number*, Index, const Number*,
	        const Number*, Number, const IpoptData*, IpoptCalculatedQuantities*)
	{
		solution_.assign(z, z + n);
	}

	/// Ipopt's objects, made once a thread and used again for every pair.
	class IpoptRunner {
	public:
		IpoptRunner();
		IpoptOutcome solve(int dimension, int count, const Real* const* normal, const Real* offset, Real* x, int& iterations);

	private:
		ApplicationReturnStatus optimise();

		SmartPtr<CentreProgramme>   programme_ = new CentreProgramme;
		SmartPtr<IpoptLinearSolver> linear_    = new IpoptLinearSolver;
		SmartPtr<IpoptApplication>  application_;
		SmartPtr<NLP>               adapter_;
		bool                        algorithm_ = false; ///< made, and to be used again
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
		options.SetIntegerValue("acceptable_iter", 3); // rounding keeps a badly scaled round above `tol`: on to the next
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
		adapter_                           = new TNLPAdapter(GetRawPtr(programme_), ConstPtr(application_->Jnlst()));
		algorithm_                         = true;
		return application_->OptimizeNLP(adapter_, builder);
	}

	IpoptOutcome IpoptRunner::solve(int dimension, int count, const Real* const* normal, const Real* offset, Real* x, int& iterations)
	{
		if (!IsValid(application_)) return IpoptOutcome::Failed;
		linear_->setDimension(dimension);
		programme_->start(dimension, count, normal, offset, x);
		if (programme_->inside()) programme_->moveToMiddle();
		// A round ends where Ipopt's tolerance, rounding or the limit of iterations ends it. Each starts from the last one's
		// point with a scaling of its own, until one finds nothing to do: then its numbers were about one.
		for (int round = 0; round < tolerance::ipoptRounds; ++round) {
			programme_->scale();
			const ApplicationReturnStatus status = optimise();
			if (IsValid(application_->Statistics())) iterations += application_->Statistics()->IterationCount();
			const Real moved  = programme_->moveToSolution();
			const bool inside = programme_->inside();
			if (!(moved >= 0) || (!inside && status != Maximum_Iterations_Exceeded)) return IpoptOutcome::Failed;
			if (inside && status == Solve_Succeeded && moved <= tolerance::ipoptMove) {
				for (int k = 0; k < dimension; ++k)
					x[k] = programme_->point()[k];
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
