// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <src/contact/ContactQuery.hpp>
#include <src/timestep/ClosingStep.hpp>

#include <limits>

/// Two convex bodies that go on as they move now, and the time step in which they may close their joint.
namespace yade {

/// Where a body, or a member of a clump, will be.
struct Course {
	Vector3r position;
	Matrix3r rotation;
	Vector3r centre, velocity, acceleration, spin; ///< of what moves: the body or its clump

	Vector3r positionAfter(Real time) const
	{
		return centre + time * velocity + time * time / 2 * acceleration + turnAfter(time) * (position - centre);
	}
	Matrix3r rotationAfter(Real time) const { return turnAfter(time) * rotation; }
	/// Highest speed until then of a point so far from the body's centre, against one that does not move [m/s].
	Real speedOf(Real radius) const { return spin.norm() * ((position - centre).norm() + radius); }

private:
	Matrix3r turnAfter(Real time) const
	{
		const Real rate = spin.norm();
		return rate > 0 ? AngleAxisr(rate * time, spin / rate).toRotationMatrix() : Matrix3r(Matrix3r::Identity());
	}
};

/// A convex shape on its course; the first of two may be a half-space.
struct MovingShape {
	const polytope::ConvexShape& shape;
	Course                       course;

	bool endless() const { return !(shape.boundingRadius() < std::numeric_limits<Real>::infinity()); }
	Real spinSpeed() const { return endless() ? Real(0) : course.speedOf(shape.boundingRadius()); }
};

class MovingPair {
public:
	MovingPair(const MovingShape& one, const MovingShape& other) : one_(one), other_(other) { }

	/// How far they overlap after that time [m], as twice the radius of the largest ball in the overlap; negative: a gap.
	Real closedAfter(Real time)
	{
		const Matrix3r            rotation1 = one_.course.rotationAfter(time), rotation2 = other_.course.rotationAfter(time);
		const Vector3r            centre2 = other_.course.positionAfter(time) - one_.course.positionAfter(time);
		polytope::ContactSettings settings;
		settings.warmStart    = false;
		settings.programAlone = true;
		// × size: the program goes on to the end across any gap of theirs
		settings.tolerance = -1 - centre2.norm() / other_.shape.boundingRadius();
		polytope::PairMemory    memory;
		polytope::ContactResult result;
		polytope::contactQuery({ one_.shape, rotation1, other_.shape, rotation2, centre2 }, settings, memory, workspace_, result);
		return -2 * result.infeasibility;
	}

	/// \param law     of the joint, `closure`: by which it is closed now [m]
	/// \param touching whether it is; otherwise they will touch at a closure of 0
	/// \param horizon until then [s]
	/// \param steps   until the step is found anew
	/// \returns the time step [s]; infinite where the joint does not stiffen much until the horizon
	Real step(const polytope::ClosureLaw& law, Real closure, bool touching, Real horizon, Real steps)
	{
		using namespace polytope;
		const Real     infinite     = std::numeric_limits<Real>::infinity();
		const Vector3r velocity     = other_.course.velocity - one_.course.velocity,
		               acceleration = other_.course.acceleration - one_.course.acceleration;
		const Real speed            = velocity.norm() + horizon * acceleration.norm() + one_.spinSpeed() + other_.spinSpeed(),
		           most             = speed * horizon;
		if (!(most > 0 && closingWay(law, closure, most) < most)) return infinite;
		Real now = 0, least = infinite;
		if (touching) { // opening is as steep
			now               = closedAfter(0);
			const Real after  = tolerance::closingDifference * horizon;
			const Real moving = math::abs(closedAfter(after) - now) / after;
			least             = closingWay(law, closure, most) / moving;
		}
		const Real radius = math::min(one_.shape.inscribedRadius(), other_.shape.inscribedRadius());
		const int  places = int(math::min(Real(tolerance::closingPlaces), Real(1 + math::floor(most / radius))));
		for (int k = 1; k <= places; ++k) {
			const Real time = horizon * k / places, closed = closedAfter(time), farther = closed - now;
			if (!(farther > 0)) continue;
			const Real way = closingWay(law, closure, farther);
			if (!(way < farther)) continue;
			// sideways, onto the next piece of a floor, they do not close however fast they move
			const Real before = tolerance::closingDifference * time, closing = (closed - closedAfter(time - before)) / before;
			if (!(closing > 0)) continue;
			const Real untilTouch = touching ? Real(0) : math::max(Real(time - closed / closing), Real(0));
			return math::min(least, closingStep(way, closing, untilTouch, steps));
		}
		return least;
	}

private:
	const MovingShape          one_, other_;
	polytope::ContactWorkspace workspace_;
};

} // namespace yade
