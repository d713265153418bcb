// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearReturn.hpp"

#include "shear/ShearTolerances.hpp"

#include <Eigen/Cholesky>

#include <limits>

namespace polytope {
namespace {

	/// A slip, the resistance to it, and how that changes with the slip. A slip that is longer meets the same resistance, which changes the less.
	struct Motion {
		Vector3 slip;
		Matrix3 slope; // before the resistance, whose function writes it
		Vector3 resistance;

		Motion(const ShearStrength& strength, const Vector3& slip_) : slip(slip_), resistance(strength.resistance(slip, &slope)) { }
		/// Work that the strength takes (Euler).
		Real taken() const { return slip.dot(resistance); }
		void lengthen(Real by)
		{
			slip *= by;
			slope /= by;
		}
	};

	/// The normal of a limit surface that is an ellipsoid, where the load crosses it: near to the slip that the load brings about (Howe & Cutkosky 1996,
	/// "Practical force-motion models for sliding manipulation", International Journal of Robotics Research 15:557-572).
	Vector3 likelyMotion(const ShearStrength& strength, const Vector3& load)
	{
		const Real radius = strength.leastRadius();
		return Vector3(load[0] * radius * radius, load[1] * radius * radius, load[2]);
	}

	/// Whether the load is a mean of a point of the limit surface and of one that ShearStrength::surelyHolds() knows to be within: the surface
	/// is convex.
	bool holdsBeside(const ShearStrength& strength, const Vector3& onSurface, const Vector3& load)
	{
		const auto holds = [&](Real share) {
			if (!(share > 0 && share < 1)) return false;
			return strength.surelyHolds((load - share * onSurface) / (1 - share));
		};
		return holds(load.head<2>().dot(onSurface.head<2>()) / onSurface.head<2>().squaredNorm()) || holds(load[2] / onSurface[2]);
	}

	/// Looks for a motion in which the load does more work than the strength takes, and returns whether there is one; if not, the load is
	/// within the limit surface.
	///
	/// The motion sought is the one that takes the least work of the strength, among all in which the load does the same work: it minimises a convex
	/// function of two variables.
	bool findMotionBeyond(const ShearStrength& strength, const Matrix3& stiffness, const Vector3& load, Motion& motion)
	{
		motion.lengthen(1 / load.dot(motion.slip)); // the load gives 1
		if (motion.taken() < 1) return true;
		// axes across the load that are orthogonal by the energy
		const Eigen::LLT<Matrix3> root(stiffness);
		const Vector3             along = root.matrixL().solve(load), across1 = along.unitOrthogonal(),
		              across2 = along.normalized().cross(across1);
		Eigen::Matrix<Real, 3, 2> axes;
		axes << Vector3(root.matrixU().solve(across1)), Vector3(root.matrixU().solve(across2));

		for (int step = 0; step < tolerance::shearReturnSteps; ++step) {
			const Real taken = motion.taken();
			if (taken < 1) return true;
			if (holdsBeside(strength, motion.resistance, load)) return false;
			const Eigen::Matrix<Real, 2, 2> hessian = axes.transpose() * motion.slope * axes;
			const Vector2 gradient = axes.transpose() * motion.resistance, change = hessian.ldlt().solve(gradient);
			const Real    fall = change.dot(gradient);
			if (!(fall > Real(tolerance::shearMotion) * taken)) return false;
			Real   part = 1;
			Motion next = motion;
			for (int halved = 0; halved < tolerance::shearHalvings; ++halved, part /= 2) {
				next = Motion(strength, motion.slip - part * axes * change);
				if (next.taken() <= taken - part * fall / 4) break;
			}
			motion = next;
		}
		return false;
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

Vector3 returnToStrength(const ShearStrength& strength, const Matrix3& stiffness, Vector3& load, Vector3& likely)
{
	if (strength.surelyHolds(load)) return Vector3::Zero();
	const Eigen::LDLT<Matrix3> compliance(stiffness);
	const Real                 energy = load.dot(compliance.solve(load)); // twice what the bed stores
	if (!(energy > 0)) return Vector3::Zero();
	Motion     motion(strength, load.dot(likely) > 0 ? likely : likelyMotion(strength, load));
	const bool slips = findMotionBeyond(strength, stiffness, load, motion);
	likely           = motion.slip;
	if (!slips) return Vector3::Zero();

	const auto toBestLength = [&] {
		const Real length = motion.slip.dot(load - motion.resistance) / motion.slip.dot(stiffness * motion.slip);
		if (length > 0) motion.lengthen(length);
	};
	// D(x) − load·x + x·K x/2
	const auto work = [&](const Motion& of) { return of.slip.dot(of.resistance - load) + of.slip.dot(stiffness * of.slip) / 2; };
	toBestLength();
	Real lastSlope = std::numeric_limits<Real>::infinity();
	for (int step = 0; step < tolerance::shearReturnSteps; ++step) {
		const Vector3 gradient = motion.resistance - load + stiffness * motion.slip;
		const Vector3 change   = Matrix3(motion.slope + stiffness).ldlt().solve(gradient);
		const Real    slope = change.dot(gradient), square = motion.slip.dot(stiffness * motion.slip);
		if (!(slope > 0)) break;
		// so near that rounding decides what is less work, or that a whole step is right: each doubles the digits until nothing is left to gain
		const Real room = Real(tolerance::sumsOfWork) * abs(motion.slip.dot(load));
		const bool near = slope <= Real(tolerance::shearReturn * tolerance::shearReturn) * square || slope <= 4 * room;
		if (near && !(slope < lastSlope / 4)) break;
		if (near) lastSlope = slope;
		const Real now  = work(motion);
		Real       part = 1;
		Motion     next(strength, motion.slip - change);
		for (int halved = 0; !near && halved < tolerance::shearHalvings && !(work(next) <= now - part * slope / 4); ++halved) {
			part /= 2;
			next = Motion(strength, motion.slip - part * change);
		}
		motion = next;
		if (near) {
			const Vector3 off = motion.resistance - load + stiffness * motion.slip;
			if (off.dot(compliance.solve(off)) <= Real(tolerance::shearOff * tolerance::shearOff) * energy) break;
		} else toBestLength();
	}
	const Vector3 left = load - stiffness * motion.slip, off = left - motion.resistance;
	// both are the same; where a slip is small beside the strain, the latter has all digits
	const bool same = off.dot(compliance.solve(off)) <= Real(tolerance::shearReturn * tolerance::shearReturn) * energy;
	load            = same ? left : motion.resistance;
	likely          = motion.slip;
	return motion.slip;
}

} // namespace polytope
