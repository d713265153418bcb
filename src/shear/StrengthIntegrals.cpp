// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/StrengthIntegrals.hpp"

#include "numbers/InstructionSet.hpp"
#include "numbers/Lanes.hpp"

namespace polytope {
namespace {

	/// `width` edges of an outline from one on, in place of those that are not there the first.
	template <int width> struct Edges {
		using V = typename Lanes<Real, width>::Type;
		V from[2], to[2], there; ///< 1, or 0

		POLYTOPE_INLINE Edges(const SpreadStrength& of, int first)
		{
			Real rows[5][width];
			for (int t = 0; t < width; ++t) {
				const bool in  = first + t < of.count;
				const int  one = in ? first + t : 0, two = one + 1 < of.count ? one + 1 : 0;
				for (int m = 0; m < 2; ++m) {
					rows[m][t]     = of.corners[2 * one + m] + of.shift[m];
					rows[2 + m][t] = of.corners[2 * two + m] + of.shift[m];
				}
				rows[4][t] = in;
			}
			for (int m = 0; m < 2; ++m) {
				from[m] = load<Real, width>(rows[m]);
				to[m]   = load<Real, width>(rows[2 + m]);
			}
			there = load<Real, width>(rows[4]);
		}
	};

	template <int width>
	POLYTOPE_INLINE void atPoints(
	        const SpreadStrength& of, const Real (&slip)[3], const GaussLegendre& rule, bool slope, IntegralsAtPoints& out)
	{
		using V   = typename Lanes<Real, width>::Type;
		V sums[9] = {};
		for (int k = 0; k < of.count; k += width) {
			const Edges<width> edges(of, k);
			const V(&from)[2] = edges.from;
			const V along0 = edges.to[0] - from[0], along1 = edges.to[1] - from[1],
			        twice = edges.there * (from[0] * along1 - from[1] * along0);
			for (int j = 0; j < rule.points; ++j) {
				const V edge0 = from[0] + rule.place[j] * along0, edge1 = from[1] + rule.place[j] * along1,
				        rise = of.gradient[0] * edge0 + of.gradient[1] * edge1;
				for (int i = 0; i < rule.points; ++i) {
					const Real place = rule.place[i];
					const V    x0 = place * edge0, x1 = place * edge1;
					const V    share = rule.weight[i] * rule.weight[j] * place * twice * (of.atCentre + place * rise);
					const V    v0 = slip[0] - slip[2] * x1, v1 = slip[1] + slip[2] * x0,
					        speed = squareRoot<Real, width>(v0 * v0 + v1 * v1), d0 = v0 / speed, d1 = v1 / speed;
					sums[0] += share * d0;
					sums[1] += share * d1;
					sums[2] += share * (x0 * d1 - x1 * d0);
					if (!slope) continue;
					const V part = share / speed, arm = x0 * d0 + x1 * d1; // of the direction across
					sums[3] += part * d1 * d1;
					sums[4] -= part * d1 * d0;
					sums[5] += part * d0 * d0;
					sums[6] -= part * d1 * arm;
					sums[7] += part * d0 * arm;
					sums[8] += part * arm * arm;
				}
			}
		}
		horizontalSums<Real, width>(sums, out.all);
	}

	/// Integrals along lines at the distance h from the pole, their points h m + y e from there with y from y₁ to y₂, ρ² = h² + y².
	template <int width> struct LineIntegrals {
		using V = typename Lanes<Real, width>::Type;
		V e[2], m[2], length, h, y1;
		V y[4];         ///< ∫ yᵏ/ρ dy
		V rho[3];       ///< ∫ ρ yᵏ dy
		V overCubed[5]; ///< ∫ yᵏ/ρ³ dy

		/// No pole is on its line between the ends.
		POLYTOPE_INLINE LineIntegrals(const V (&from)[2], const V (&to)[2])
		{
			using std::log;
			const V way[2] = { to[0] - from[0], to[1] - from[1] };
			length         = squareRoot<Real, width>(way[0] * way[0] + way[1] * way[1]);
			e[0]           = way[0] / length;
			e[1]           = way[1] / length;
			m[0]           = e[1];
			m[1]           = -e[0];
			h              = from[0] * m[0] + from[1] * m[1];
			y1             = from[0] * e[0] + from[1] * e[1];
			const V square = h * h, y2 = to[0] * e[0] + to[1] * e[1],
			        r1     = squareRoot<Real, width>(from[0] * from[0] + from[1] * from[1]),
			        r2     = squareRoot<Real, width>(to[0] * to[0] + to[1] * to[1]);
			const V beyond = (y2 + r2) / (y1 + r1), before = (r1 - y1) / (r2 - y2), between = (y2 + r2) * (r1 - y1) / square;
			Real    ratio[width];
			store<Real, width>(ratio, y1 >= 0 ? beyond : y2 <= 0 ? before : between);
			for (Real& each : ratio)
				each = log(each);
			y[0]   = load<Real, width>(ratio);
			y[1]   = r2 - r1;
			y[2]   = (y2 * r2 - y1 * r1 - square * y[0]) / 2;
			y[3]   = (r2 * r2 * r2 - r1 * r1 * r1) / 3 - square * y[1];
			rho[0] = y[2] + square * y[0];
			rho[1] = y[3] + square * y[1];
			rho[2] = (y2 * r2 * r2 * r2 - y1 * r1 * r1 * r1 - square * rho[0]) / 4;
			// y₂/r₂ − y₁/r₁ vanishes with h where the line points to the pole
			const V oneSide = (y2 - y1) * (y2 + y1) / (r1 * r2 * (y2 * r1 + y1 * r2)), bothSides = (y2 / r2 - y1 / r1) / square;
			overCubed[0] = y1 * y2 > 0 ? oneSide : bothSides;
			overCubed[1] = 1 / r1 - 1 / r2;
			for (int k = 0; k < 3; ++k)
				overCubed[k + 2] = y[k] - square * overCubed[k];
		}
	};

	/// IntegralsAboutPole of several edges.
	template <int width> struct Sums {
		using V  = typename Lanes<Real, width>::Type;
		V all[6] = {}; ///< radial, distance, tensor

		/// Where `which` is not zero: a vector by its parts `across` the line and `along` it, `distance`, and a tensor by its own.
		POLYTOPE_INLINE void add(const V& which, const LineIntegrals<width>& line, const V& across, const V& along,
		        const V& distance, const V& mm, const V& me, const V& ee)
		{
			const V(&e)[2] = line.e, (&m)[2] = line.m;
			const V none    = which - which,
			        each[6] = { across * m[0] + along * e[0], across * m[1] + along * e[1], distance,
				        mm * m[0] * m[0] + 2 * me * m[0] * e[0] + ee * e[0] * e[0],
				        mm * m[0] * m[1] + me * (m[0] * e[1] + e[0] * m[1]) + ee * e[0] * e[1],
				        mm * m[1] * m[1] + 2 * me * m[1] * e[1] + ee * e[1] * e[1] };
			for (int s = 0; s < 6; ++s)
				all[s] += which > none ? each[s] : none;
		}
		POLYTOPE_INLINE IntegralsAboutPole together() const
		{
			Real sum[6];
			horizontalSums<Real, width>(all, sum);
			return { { sum[0], sum[1] }, sum[2], { sum[3], sum[4], sum[5] } };
		}
	};

	/// Triangles between the pole, where τ would be `atPole`, and the edges.
	template <int width> POLYTOPE_INLINE IntegralsAboutPole overTriangles(const SpreadStrength& of, const Real (&pole)[2])
	{
		using V            = typename Lanes<Real, width>::Type;
		const Real  atPole = of.atCentre + of.gradient[0] * pole[0] + of.gradient[1] * pole[1];
		Sums<width> sums;
		for (int k = 0; k < of.count; k += width) {
			const Edges<width> edges(of, k);
			const V            from[2] = { edges.from[0] - pole[0], edges.from[1] - pole[1] },
			        to[2]              = { edges.to[0] - pole[0], edges.to[1] - pole[1] };
			const LineIntegrals<width> line(from, to);
			const V(&e)[2] = line.e, (&m)[2] = line.m, &h = line.h, square = h * h; // m: outwards of a pole inside
			const V gm = of.gradient[0] * m[0] + of.gradient[1] * m[1], ge = of.gradient[0] * e[0] + of.gradient[1] * e[1];
			const V a = atPole / 2 + gm * h / 3, b = ge / 3, across = h * h * (a * line.y[0] + b * line.y[1]),
			        along = h * (a * line.y[1] + b * line.y[2]), p = atPole + gm * h / 2, q = ge / 2;
			const V(&c)[5] = line.overCubed;
			const V mm = h * square * (p * c[0] + q * c[1]), me = square * (p * c[1] + q * c[2]),
			        ee       = h * (p * c[2] + q * c[3]);
			const V distance = h * ((atPole / 3 + gm * h / 4) * line.rho[0] + ge / 4 * line.rho[1]);
			// one that the pole sees from its end, or in line, has no triangle, nor has one between two corners in one place, whose h is no number
			const V none = edges.there - edges.there,
			        seen = absolute(h) > Real(tolerance::shearPole) * line.length ? edges.there : none;
			sums.add(seen, line, across, along, distance, mm, me, ee);
		}
		return sums.together();
	}

	template <int width>
	POLYTOPE_INLINE IntegralsAboutPole alongLines(
	        const SpreadStrength& of, const Real (&axis)[2], const Real (&pole)[2], const GaussLegendre& lines)
	{
		using V = typename Lanes<Real, width>::Type;
		// along the axis and across it
		const auto turned = [&](const auto& x0, const auto& x1, auto(&out)[2]) POLYTOPE_INLINE_LAMBDA {
			out[0] = axis[0] * x0 + axis[1] * x1;
			out[1] = axis[0] * x1 - axis[1] * x0;
		};
		Real far[2], gradient[2];
		turned(pole[0], pole[1], far);
		turned(of.gradient[0], of.gradient[1], gradient);
		Sums<width> sums;
		for (int k = 0; k < of.count; k += width) {
			const Edges<width> edges(of, k);
			V                  from[2], to[2];
			turned(edges.from[0], edges.from[1], from);
			turned(edges.to[0], edges.to[1], to);
			const V none = from[0] - from[0], one = none + 1;
			// the edges run against the axis where the outline is above it
			const V whole = edges.there * (from[0] - to[0]), widening = to[1] - from[1];
			for (int i = 0; i < lines.points; ++i) {
				const Real place = lines.place[i];
				const V    share = lines.weight[i] * whole, begin[2] = { from[0] - far[0], place * from[1] - far[1] },
				        end[2]        = { to[0] - far[0], place * to[1] - far[1] },
				        way[2]        = { end[0] - begin[0], end[1] - begin[1] },
				        lengthSquared = way[0] * way[0] + way[1] * way[1],
				        farSquared    = begin[0] * begin[0] + begin[1] * begin[1],
				        atBegin       = of.atCentre + gradient[0] * from[0] + gradient[1] * (place * from[1]);
				const V given         = absolute(share) > none ? one : none,
				        isShort
				        = lengthSquared * Real(tolerance::shearShort * tolerance::shearShort) < farSquared ? given : none,
				        isLong = given - isShort;
				if (horizontalMax<Real, width>(isShort) > 0) {
					const V     ratio   = isShort > none ? V(farSquared / lengthSquared) : V(one * Real(padOffset));
					const Real  lengths = sqrt(horizontalMin<Real, width>(ratio));
					const auto& rule    = GaussLegendre::seenFrom(lengths);
					const V     rise = gradient[0] * way[0] + gradient[1] * way[1], own = isShort > none ? share : none;
					for (int j = 0; j < rule.points; ++j) {
						const Real at = rule.place[j];
						const V    r0 = begin[0] + at * way[0], r1 = begin[1] + at * way[1],
						        square = r0 * r0 + r1 * r1,
						        part   = own * rule.weight[j] * (from[1] + at * widening) * (atBegin + at * rise)
						        / squareRoot<Real, width>(square),
						        over = part / square;
						sums.all[0] += part * r0;
						sums.all[1] += part * r1;
						sums.all[2] += part * square;
						sums.all[3] += over * r0 * r0;
						sums.all[4] += over * r0 * r1;
						sums.all[5] += over * r1 * r1;
					}
				}
				if (!(horizontalMax<Real, width>(isLong) > 0)) continue;
				const LineIntegrals<width> line(begin, end);
				const V(&e)[2] = line.e, &h = line.h;
				// width times τ, as q₀ + q₁ y + q₂ y²
				const V w1 = widening / line.length, w0 = from[1] - w1 * line.y1,
				        t1 = gradient[0] * e[0] + gradient[1] * e[1], t0 = atBegin - t1 * line.y1,
				        part      = share / line.length;
				const V q[3]      = { part * w0 * t0, part * (w0 * t1 + w1 * t0), part * w1 * t1 };
				V       radial[2] = { none, none }, tensor[3] = { none, none, none }, distance = none;
				for (int power = 0; power < 3; ++power) {
					for (int n = 0; n < 2; ++n)
						radial[n] += q[power] * line.y[power + n];
					for (int n = 0; n < 3; ++n)
						tensor[n] += q[power] * line.overCubed[power + n];
					distance += q[power] * line.rho[power];
				}
				sums.add(isLong, line, radial[0] * h, radial[1], distance, tensor[0] * h * h, tensor[1] * h, tensor[2]);
			}
		}
		// back to the outline's axes
		const IntegralsAboutPole own = sums.together();
		const Real               a = axis[0], b = axis[1], t0 = own.tensor[0], t1 = own.tensor[1], t2 = own.tensor[2];
		return { { a * own.radial[0] - b * own.radial[1], b * own.radial[0] + a * own.radial[1] }, own.distance,
			{ a * a * t0 - 2 * a * b * t1 + b * b * t2, a * b * (t0 - t2) + (a * a - b * b) * t1,
			        b * b * t0 + 2 * a * b * t1 + a * a * t2 } };
	}

	struct Functions {
		void (*atPoints)(const SpreadStrength&, const Real (&)[3], const GaussLegendre&, bool, IntegralsAtPoints&);
		IntegralsAboutPole (*overTriangles)(const SpreadStrength&, const Real (&)[2]);
		IntegralsAboutPole (*alongLines)(const SpreadStrength&, const Real (&)[2], const Real (&)[2], const GaussLegendre&);
	};

#define POLYTOPE_INTEGRALS(NAME, TARGET, WIDTH)                                                                                            \
	struct NAME {                                                                                                                      \
		TARGET static void points(                                                                                                 \
		        const SpreadStrength& of, const Real (&slip)[3], const GaussLegendre& rule, bool slope, IntegralsAtPoints& out)    \
		{                                                                                                                          \
			atPoints<WIDTH>(of, slip, rule, slope, out);                                                                       \
		}                                                                                                                          \
		TARGET static IntegralsAboutPole triangles(const SpreadStrength& of, const Real (&pole)[2])                                \
		{                                                                                                                          \
			return overTriangles<WIDTH>(of, pole);                                                                             \
		}                                                                                                                          \
		TARGET static IntegralsAboutPole lines(                                                                                    \
		        const SpreadStrength& of, const Real (&axis)[2], const Real (&pole)[2], const GaussLegendre& rule)                 \
		{                                                                                                                          \
			return alongLines<WIDTH>(of, axis, pole, rule);                                                                    \
		}                                                                                                                          \
		static constexpr Functions all { points, triangles, lines };                                                               \
	};

#if defined(__x86_64__) && POLYTOPE_REAL_IS_DOUBLE
	POLYTOPE_INTEGRALS(V4, __attribute__((target("arch=x86-64-v4"))), 4)
	POLYTOPE_INTEGRALS(V3, __attribute__((target("arch=x86-64-v3"))), 4)
	POLYTOPE_INTEGRALS(V1, , 4)

	Functions choose()
	{
		switch (instructionSetOfMachine()) {
			case InstructionSet::V4: return V4::all;
			case InstructionSet::V3: return V3::all;
			default: return V1::all;
		}
	}
#else
	POLYTOPE_INTEGRALS(Scalar, , 1)

	Functions choose() { return Scalar::all; }
#endif

	const Functions functions = choose();

} // namespace

IntegralsAtPoints strengthAtPoints(const SpreadStrength& of, const Real (&slip)[3], const GaussLegendre& rule, bool slope)
{
	IntegralsAtPoints out;
	functions.atPoints(of, slip, rule, slope, out);
	return out;
}

IntegralsAboutPole strengthOverTriangles(const SpreadStrength& of, const Real (&pole)[2]) { return functions.overTriangles(of, pole); }

IntegralsAboutPole strengthAlongLines(const SpreadStrength& of, const Real (&axis)[2], const Real (&pole)[2], const GaussLegendre& lines)
{
	return functions.alongLines(of, axis, pole, lines);
}

} // namespace polytope
