// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearReturn.hpp"

#include "shear/ShearTolerances.hpp"

#include <Eigen/Cholesky>

namespace polytope {
namespace {

	/// What is minimised, and its derivatives.
	struct Work {
		Real    value;
		Vector3 resistance, gradient;
		Matrix3 hessian;

		Work(const ShearStrength& strength, const Matrix3& stiffness, const Vector3& load, const Vector3& slip)
		{
			resistance = strength.resistance(slip, &hessian);
			gradient   = resistance - load + stiffness * slip;
			value      = slip.dot(resistance - load) + slip.dot(stiffness * slip) / 2; // D = slip·resistance (Euler)
			hessian += stiffness;
		}
	};

	/// A motion in which the load does more work than the strength takes; zero where there is none, so that the load is within the limit surface.
	///
	/// Of all motions in which the load does the same work it is the one that takes the least: a convex function of two variables. `all`: K⁻¹ load.
	Vector3 motionBeyond(const ShearStrength& strength, const Matrix3& stiffness, const Vector3& load, const Vector3& all)
	{
		// axes across the load that are orthogonal by the energy
		const Eigen::LLT<Matrix3> root(stiffness);
		const Vector3             across1 = Vector3(root.matrixL().solve(load)).unitOrthogonal(),
		              across2             = Vector3(root.matrixL().solve(load)).normalized().cross(across1);
		Eigen::Matrix<Real, 3, 2> axes;
		axes << Vector3(root.matrixU().solve(across1)), Vector3(root.matrixU().solve(across2));

		Vector3 motion = all / load.dot(all);
		for (int step = 0; step < tolerance::shearReturnSteps; ++step) {
			Matrix3       slope;
			const Vector3 resistance = strength.resistance(motion, &slope);
			const Real    taken      = motion.dot(resistance); // the load gives 1
			if (taken < 1) return motion;
			const Eigen::Matrix<Real, 2, 2> hessian  = axes.transpose() * slope * axes;
			const Vector2                   gradient = axes.transpose() * resistance, change = hessian.ldlt().solve(gradient);
			const Real                      fall = change.dot(gradient);
			if (!(fall > Real(tolerance::shearMotion) * taken)) break;
			Real    part = 1;
			Vector3 next = motion;
			for (int halved = 0; halved < tolerance::shearHalvings; ++halved, part /= 2) {
				next = motion - part * axes * change;
				if (next.dot(strength.resistance(next)) <= taken - part * fall / 4) break;
			}
			motion = next;
		}
		return Vector3::Zero();
	}

} // namespace

Matrix3 bedStiffness(Real stiffness, Real gyrationSquared, const Vector2& offset)
{
	Matrix3 k = Matrix3::Zero();
	k(0, 0) = k(1, 1) = stiffness;
	k(0, 2) = k(2, 0) = -stiffness * offset[1];
	k(1, 2) = k(2, 1) = stiffness * offset[0];
	k(2, 2)           = stiffness * (gyrationSquared + offset.squaredNorm());
	return k;
}

Vector3 returnToStrength(const ShearStrength& strength, const Matrix3& stiffness, Vector3& load)
{
	if (strength.surelyHolds(load)) return Vector3::Zero();
	const Vector3 all = stiffness.ldlt().solve(load);
	if (!(all.dot(load) > 0)) return Vector3::Zero();
	Vector3 slip = motionBeyond(strength, stiffness, load, all);
	if (slip == Vector3::Zero()) return slip;
	const auto toBestLength = [&] {
		const Real length = slip.dot(load - strength.resistance(slip)) / slip.dot(stiffness * slip);
		if (length > 0) slip *= length;
	};
	toBestLength();
	for (int step = 0; step < tolerance::shearReturnSteps; ++step) {
		const Work    now(strength, stiffness, load, slip);
		const Vector3 change = now.hessian.ldlt().solve(now.gradient);
		const Real    slope = change.dot(now.gradient), square = slip.dot(stiffness * slip);
		if (!(slope > 0)) break;
		// a step of Newton's method doubles the digits: after one from so near nothing is left to gain, and rounding decides what is less
		const bool last = slope <= Real(tolerance::shearReturn * tolerance::shearReturn) * square;
		Real       part = 1;
		// near the minimum the work falls by less than it is rounded
		const Real room = Real(tolerance::sumsOfWork) * abs(slip.dot(load));
		for (int halved = 0; !last && halved < tolerance::shearHalvings; ++halved, part /= 2)
			if (Work(strength, stiffness, load, slip - part * change).value <= now.value - part * slope / 4 + room) break;
		slip -= part * change;
		if (last) break;
		toBestLength();
	}
	const Vector3 onSurface = strength.resistance(slip), left = load - stiffness * slip, off = left - onSurface;
	// both are the same; where a slip is small beside the strain, the latter has all digits
	const bool same = off.dot(stiffness.ldlt().solve(off)) <= Real(tolerance::shearReturn * tolerance::shearReturn) * all.dot(load);
	load            = same ? left : onSurface;
	return slip;
}

} // namespace polytope
