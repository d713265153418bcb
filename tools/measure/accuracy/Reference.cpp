// SPDX-License-Identifier: GPL-2.0-or-later
#include "Reference.hpp"

#include "ExactLp.hpp"
#include "PrecisePair.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace polytope::samples {
namespace {

	using boost::multiprecision::cpp_bin_float;
	using Digits150 = boost::multiprecision::number<cpp_bin_float<150>, boost::multiprecision::et_off>;
	using Vector    = PreciseVector<Digits150>;

	/// The optimum of the linear program, whatever the dimension.
	struct ExactOptimum {
		Digits150 infeasibility;
		Vector    point {};
	};

	template <int D> ExactOptimum solvedExactly(const Pair& pair)
	{
		const ExactLp<D> lp(pair);
		ExactOptimum     optimum;
		optimum.infeasibility = Digits150(numerator(lp.infeasibility)) / Digits150(denominator(lp.infeasibility));
		for (int k = 0; k < D; ++k)
			optimum.point[k] = Digits150(numerator(lp.point[k])) / Digits150(denominator(lp.point[k]));
		return optimum;
	}

	ExactOptimum solvedExactly(const Pair& pair) { return pair.dimension() == 2 ? solvedExactly<2>(pair) : solvedExactly<3>(pair); }

	bool allFinite(const ContactResult& r)
	{
		return r.point.allFinite() && r.normal.allFinite() && r.dualDirection.allFinite() && r.sectionCentroid.allFinite()
		        && std::isfinite(r.depth) && std::isfinite(r.infeasibility) && std::isfinite(r.area) && std::isfinite(r.energy);
	}

	/// Whatever the status: the geometry is bounded by the bodies' size, so a law's forces are, too.
	bool isBounded(const PrecisePairOf<Digits150>& exact, const Pair& pair, const ContactResult& r)
	{
		if (!r.hasGeometry) return !r.inContact;
		if (!(std::abs(r.normal.norm() - 1) < 1e-14)) return false;
		if (!r.inContact) return true;
		const Real larger = std::max(pair.shape[0]->boundingRadius(), pair.shape[1]->boundingRadius());
		if (!(r.depth > 0) || !(r.depth <= 2 * (larger + pair.size()))) return false;
		return exact.violation(precise<Digits150>(r.point)) / Digits150(pair.size())
		        <= Digits150(1e-14); // the point is in the overlap
	}

	Real relative(const Digits150& difference, const Digits150& size) { return Real(abs(difference) / size); }

	/// The normal at the reference's centre (Eq. 17). False where there is none.
	bool referenceNormal(
	        const PrecisePairOf<Digits150>& exact, const Vector& x, ContactStatus status, const Vector3& dual, Vector& normal)
	{
		if (status == ContactStatus::NormalFromDual) {
			normal = precise<Digits150>(
			        dual.normalized()); // not unique where the program's basis is not: checked by its property instead
			return true;
		}
		if (status != ContactStatus::NormalFromOneBody) return exact.normal(x, normal);
		const Vector    first = exact.innerGradient(0, x), second = exact.innerGradient(1, x);
		const bool      ofFirst = norm(first) > 0;
		const Digits150 length  = norm(ofFirst ? first : second);
		if (!(length > 0)) return false;
		normal = along(Vector {}, (ofFirst ? 1 : -1) / length, ofFirst ? first : second);
		return true;
	}

	/// How far the normal at x turns when the point moves by `move` in the local norm.
	Real turnedBy(const PrecisePairOf<Digits150>& exact, const Vector& x, const Digits150& move)
	{
		Digits150 slip = 0;
		Vector    sum {};
		for (int body = 0; body < 2; ++body) {
			const Vector    gradient = exact.innerGradient(body, x);
			const Digits150 length   = norm(gradient);
			if (!(length > 0)) continue;
			slip += exact.normalSlip(body, x, move);
			sum = along(sum, (body == 0 ? 1 : -1) / length, gradient);
		}
		const Digits150 left = norm(sum); // nearly opposite gradients cancel
		return Real(left > 0 && left < 1 ? Digits150(slip / left) : slip);
	}

	void compareGeometry(const Pair& pair, const ExactOptimum& optimum, Comparison& c)
	{
		const ContactResult&           r = c.result;
		const PrecisePairOf<Digits150> exact(pair);
		const Digits150                size = pair.size();
		c.bounded                           = isBounded(exact, pair, r);
		if (!r.inContact || !(optimum.infeasibility < 0)) return;
		Vector centre = optimum.point, normal;
		if (!exact.analyticCentre(centre) || !referenceNormal(exact, centre, r.status, r.dualDirection, normal)) return;
		c.compared            = true;
		const Digits150 depth = exact.depth(centre, normal);
		const Vector    ours = precise<Digits150>(r.point), n = precise<Digits150>(r.normal);
		c.centreError        = Real(exact.localLength(centre, minus(ours, centre)));
		c.normalError        = Real(norm(minus(n, normal)));
		c.forceError         = Real(norm(minus(along(Vector {}, Digits150(r.depth), n), along(Vector {}, depth, normal))) / size);
		c.depth              = Real(depth / size);
		c.depthError         = relative(Digits150(r.depth) - depth, size);
		const Real roundings = c.infeasibilityRounding * c.size;
		c.centreRounding     = 2e-9 + 2 * roundings / Real(-optimum.infeasibility);
		c.normalRounding
		        = 1e-14 + (r.status == ContactStatus::NormalFromDual ? Real(0) : turnedBy(exact, centre, c.centreRounding));
		const auto exit1 = exact.exit(0, centre, normal, 1), exit2 = exact.exit(1, centre, normal, -1);
		const Real glance = Real(1 / exit1.rate + 1 / exit2.rate);
		// the way to a plane that is met at a grazing angle is as uncertain as the angle
		c.depthRounding = glance * (roundings / c.size + c.normalRounding * c.depth);
	}

	/// Whether the bodies are separated after the motion along the dual direction that the theory requires, by the exact program.
	bool isFree(const Pair& pair, const ContactResult& r, const Digits150& infeasibility)
	{
		const Real length = r.dualDirection.norm();
		if (!(length > 0)) return false;
		const Real way  = Real(-infeasibility) / length;
		const Pair away = movedApart(pair, way * r.dualDirection / length);
		return solvedExactly(away).infeasibility > -32 * tolerance::rounding * Digits150(pair.size() + way + pair.centre2.norm());
	}

} // namespace

Comparison compareWithReference(const Pair& pair)
{
	const ExactOptimum optimum = solvedExactly(pair);
	Comparison         c;
	c.size      = pair.size();
	c.inscribed = pair.inscribedRadius();
	ContactSettings settings;
	settings.section = true;
	c.nanoseconds    = std::numeric_limits<long>::max();
	for (int repetition = 0; repetition < 3; ++repetition) {
		const auto begin = std::chrono::steady_clock::now();
		c.result         = query(pair, settings);
		c.nanoseconds = std::min(c.nanoseconds, long(std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count()));
	}
	c.finite             = allFinite(c.result);
	const Digits150 size = pair.size();
	c.infeasibility      = Real(optimum.infeasibility / size);
	c.touches            = optimum.infeasibility < 0;
	// four roundings of planes, and of the bodies' positions
	c.infeasibilityRounding = 8 * tolerance::rounding * (c.size + pair.centre2.norm()) / c.size;
	c.within                = std::abs(c.infeasibility) <= tolerance::contact + c.infeasibilityRounding;
	const Digits150 above   = Digits150(c.result.infeasibility) - optimum.infeasibility;
	// of a separated pair ours is a lower bound
	if (c.result.inContact || above > 0) c.infeasibilityError = relative(above, size);
	compareGeometry(pair, optimum, c);
	if (c.result.status == ContactStatus::NormalFromDual) c.free = isFree(pair, c.result, optimum.infeasibility);
	return c;
}

Real deviation(const ContactResult& ours, const ContactResult& other, Real unit, Real size)
{
	if (ours.inContact != other.inContact || ours.status != other.status) return std::numeric_limits<Real>::infinity();
	const Real length = unit * size;
	return std::max(
	        { std::abs(ours.infeasibility / length - other.infeasibility / size), std::abs(ours.depth / length - other.depth / size),
	                (ours.point / length - other.point / size).norm(), (ours.normal - other.normal).norm() });
}

} // namespace polytope::samples
