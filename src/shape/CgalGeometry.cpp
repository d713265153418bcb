// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/CgalGeometry.hpp"

#include "shape/CheckedNumbers.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <CGAL/Simple_cartesian.h>

#include <type_traits>

namespace polytope::exact {
namespace {

	// The only conversions to and from CGAL's numbers. Types wider than double are converted exactly, to rationals.
	constexpr bool isDouble = std::is_same<Real, double>::value;
	using Number            = std::conditional_t<isDouble, double, CGAL::Gmpq>;
	using ExactNumber       = std::conditional_t<isDouble, CGAL::Gmpzf, CGAL::Gmpq>;
	using Kernel
	        = std::conditional_t<isDouble, CGAL::Exact_predicates_inexact_constructions_kernel, CGAL::Simple_cartesian<CGAL::Gmpq>>;

	/// Templates only so that the branch not taken is not compiled; what it names must depend on the parameters, or clang checks it.
	template <class Value, class Result = Number> Result toNumber(Value value)
	{
		if constexpr (isDouble) {
			return value;
		} else {
			using std::frexp;
			int    exponent = 0;
			Value  rest     = frexp(value, &exponent); // of size one: no part of it is beyond a double's range
			Result sum(0);
			while (rest != 0) {
				const double part = double(rest);
				sum += Result(part);
				rest -= Value(part);
			}
			const Result scale(CGAL::Gmpz(1) << long(exponent < 0 ? -exponent : exponent));
			return exponent < 0 ? Result(sum / scale) : Result(sum * scale);
		}
	}

	/// The value of a quotient, with all digits of Real.
	template <class Quotient> Real toReal(const Quotient& quotient)
	{
		if constexpr (isDouble) {
			return CGAL::to_double(quotient);
		} else {
			Number rest = quotient.numerator() / quotient.denominator();
			Real   sum  = 0;
			for (int bits = -2 * 52; bits < std::numeric_limits<Real>::digits && rest != Number(0); bits += 52) {
				const double part = CGAL::to_double(rest);
				sum += part;
				rest -= Number(part);
			}
			return sum;
		}
	}

} // namespace

DeepPoint deepest(const std::vector<Vector3>& normals, const std::vector<Real>& offsets, const Real& cap, const Bounds& bounds)
{
	CGAL::Quadratic_program<Number> program(CGAL::SMALLER, false, Number(0), false, Number(0));
	for (int k = 0; k < 3; ++k) {
		if (finite(bounds.lower[k])) program.set_l(k, true, toNumber(bounds.lower[k]));
		if (finite(bounds.upper[k])) program.set_u(k, true, toNumber(bounds.upper[k]));
	}
	for (std::size_t i = 0; i < normals.size(); ++i) {
		for (int k = 0; k < 3; ++k)
			program.set_a(k, int(i), toNumber(normals[i][k]));
		program.set_a(3, int(i), Number(1));
		program.set_b(int(i), toNumber(offsets[i]));
	}
	program.set_u(3, true, toNumber(cap));
	program.set_c(3, Number(-1));
	// Bland's rule: with CGAL's default one degenerate programs cycle for ever (found by fuzzing)
	CGAL::Quadratic_program_options options;
	options.set_pricing_strategy(CGAL::QP_BLAND);
	const auto solution = CGAL::solve_linear_program(program, ExactNumber(), options);
	DeepPoint  result;
	auto       value = solution.variable_values_begin();
	for (int k = 0; k < 3; ++k, ++value)
		result.point[k] = toReal(*value);
	result.depth = toReal(*value);
	return result;
}

int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
	using Point      = Kernel::Point_3;
	const auto point = [](const Vector3& p) { return Point(toNumber(p.x()), toNumber(p.y()), toNumber(p.z())); };
	return int(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

} // namespace polytope::exact
