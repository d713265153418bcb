// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

#include <cmath>

/// Collisions of two free bodies without damping or friction.
namespace polytope::samples {

/// The shape about its centroid, axes along its principal axes.
inline std::shared_ptr<const ConvexShape> balanced(const HalfSpaces& set)
{
	const MassProperties mass = massProperties(polyhedron(set, 1));
	const Matrix3        axes = principalAxes(mass.inertia, set.dimension).rotation;
	return ConvexShape::shared(moved(set, axes.transpose(), -axes.transpose() * mass.centroid), 0);
}

struct Body {
	std::shared_ptr<const ConvexShape> shape;
	Real                               mass;
	Vector3                            inertia;
	Vector3                            position, velocity;
	Quaternion                         orientation;
	Vector3                            spin; ///< angular momentum, body axes

	Real kineticEnergy() const { return mass * velocity.squaredNorm() / 2 + spin.cwiseProduct(spin.cwiseQuotient(inertia)).sum() / 2; }

	/// Free flight. Rotation about one principal axis after the other, symmetrically: symplectic, of second order, for any
	/// inertia (Dullweber, Leimkuhler & McLachlan 1997, J. Chem. Phys. 107:5840).
	void drift(Real time)
	{
		position += time * velocity;
		const int  axes[]  = { 0, 1, 2, 1, 0 };
		const Real parts[] = { 0.5, 0.5, 1, 0.5, 0.5 };
		for (int k = 0; k < 5; ++k) {
			const Quaternion turn(
			        Eigen::AngleAxis<Real>(parts[k] * time * spin[axes[k]] / inertia[axes[k]], Vector3::Unit(axes[k])));
			spin        = turn.conjugate() * spin;
			orientation = (orientation * turn).normalized();
		}
	}

	void kick(const Vector3& force, const Vector3& at, Real time)
	{
		velocity += time / mass * force;
		turn((at - position).cross(force), time);
	}

	void turn(const Vector3& moment, Real time) { spin += time * (orientation.conjugate() * moment); }
};

struct Collision {
	Body body[2];
	Real stiffness, duration;
	bool turning = true; ///< with the moment about the normal that a single force leaves out, where the contact has one
};

inline Collision randomCollision(std::mt19937_64& random)
{
	Collision collision;
	const int faces[] = { 4, 6, 8, 12, 20 };
	for (Body& body : collision.body) {
		HalfSpaces set = random() % 2 ? regularSolid(faces[random() % 5], 1) : randomPlanes(5 + int(random() % 16), random);
		// named: compilers differ in which argument they draw first
		const Real third = uniform(random, Real(0.3), 1), second = uniform(random, Real(0.5), 1);
		set              = stretched(set, Vector3(1, second, third));
		body.shape       = balanced(set);
		body.mass        = body.shape->mass().volume;
		body.inertia     = body.shape->mass().inertia.diagonal();
		body.orientation = Quaternion(randomRotation(random));
		body.position = body.velocity = Vector3::Zero();
		const Vector3 about           = randomDirection(random);
		const Real    turning         = uniform(random, 0, 1);
		body.spin                     = turning * body.inertia.cwiseProduct(about);
	}
	// just apart, towards each other at unit speed
	Pair pair;
	for (int k = 0; k < 2; ++k) {
		pair.shape[k]    = collision.body[k].shape;
		pair.rotation[k] = collision.body[k].orientation.toRotationMatrix();
	}
	const Vector3 direction = randomDirection(random);
	const Real    inner     = pair.inscribedRadius();
	moveTo(pair, direction, Real(0.005) * inner);
	collision.body[1].position = pair.centre2;
	collision.body[1].velocity = -direction;
	// an overlap of about 2 % of the smaller inscribed radius
	const Real mass     = 1 / (1 / collision.body[0].mass + 1 / collision.body[1].mass);
	collision.stiffness = mass / std::pow(Real(0.02) * inner, 2);
	collision.duration  = 8 * Real(M_PI) * std::sqrt(mass / collision.stiffness);
	return collision;
}

struct Outcome {
	Real energyError; ///< over the initial energy
	Real ofElastic;   ///< the same over the largest elastic energy
	Real largestArm;  ///< |turningArm| over the smaller inscribed radius
	Real momentumError;
	bool over; ///< no contact at the end
};

inline Outcome run(Collision collision, const ContactSettings& settings, int steps)
{
	Body&         a = collision.body[0];
	Body&         b = collision.body[1];
	PairMemory    memory;
	ContactResult result;
	const auto    contact = [&] {
                Pair pair;
                pair.shape[0]    = a.shape;
                pair.shape[1]    = b.shape;
                pair.rotation[0] = a.orientation.toRotationMatrix();
                pair.rotation[1] = b.orientation.toRotationMatrix();
                pair.centre2     = b.position - a.position;
                result           = query(pair, settings, &memory);
	};
	// the foundation's is a stiffness per area
	const auto stiffness = [&] {
		return settings.contactModel == ContactModel::Foundation ? collision.stiffness * result.area : collision.stiffness;
	};
	const auto kick = [&](Real time) {
		if (!result.inContact) return;
		const Vector3 force = stiffness() * result.depth * result.normal;
		const Vector3 at    = a.position + result.point;
		b.kick(force, at, time);
		a.kick(-force, at, time);
		const Vector3 moment = collision.turning ? Vector3(result.turningArm * force) : Vector3(Vector3::Zero());
		b.turn(moment, time);
		a.turn(-moment, time);
	};
	const auto energy  = [&] { return a.kineticEnergy() + b.kineticEnergy() + stiffness() * result.energy; };
	const auto angular = [&] {
		Vector3 sum = Vector3::Zero();
		for (const Body& body : collision.body)
			sum += body.mass * body.position.cross(body.velocity) + body.orientation * body.spin;
		return sum;
	};
	contact();
	const Real    before = energy(), step = collision.duration / steps;
	const Vector3 momentum = angular();
	Real          elastic = 0, arm = 0;
	for (int k = 0; k < steps; ++k) {
		kick(step / 2);
		a.drift(step);
		b.drift(step);
		contact();
		kick(step / 2);
		if (!result.inContact) continue;
		elastic = std::max(elastic, stiffness() * result.energy);
		arm     = std::max(arm, std::abs(result.turningArm) / std::min(a.shape->inscribedRadius(), b.shape->inscribedRadius()));
	}
	const Real error = std::abs(energy() - before);
	return { error / before, error / elastic, arm, (angular() - momentum).norm() / (a.mass + b.mass), !result.inContact };
}

} // namespace polytope::samples
