// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/LinearContact.hpp"
#include "contact/PairSurface.hpp"

/// Fills a LinearContact from the surface that was found.
namespace polytope {

/// Force and moment as one vector.
template <class R> struct Wrench {
	R of[6];

	POLYTOPE_INLINE Wrench(const R* force, const R* moment)
	{
		for (int k = 0; k < 3; ++k) {
			of[k]     = force[k];
			of[3 + k] = moment[k];
		}
	}
};

/// Derivative of the load's force and moment by the motion of body 2, about the frame's origin.
///
/// foundation: F = 2 P, with P = (∫ p n dS, its moment), and dV = −P·motion.
/// spring: F = 36 m G, with m = W/V, G = (Q − m P)/V = −∇m, Q = (∫ ½ p² n dS, its moment), dW = −Q·motion.
template <class R>
POLYTOPE_INLINE void slopeOfLoad(bool spring, const SurfaceSums<R, 3>& sums, const SurfaceStiffness<R>& stiffness, R (&slope)[6][6])
{
	const R         mean = spring ? sums.level / sums.volume : R(0), inverse = spring ? 1 / sums.volume : R(0);
	const Wrench<R> p(sums.force, sums.moment), q(sums.deeper, sums.deeperTurn);
	R               g[6];
	for (int i = 0; i < 6; ++i)
		g[i] = (q.of[i] - mean * p.of[i]) * inverse;
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 6; ++j)
			slope[i][j] = !spring ? 2 * stiffness.force[i][j]
			                      : 36
			                * (mean * inverse
			                                * (stiffness.deeper[i][j] - mean * stiffness.force[i][j] + p.of[i] * g[j]
			                                        + g[i] * p.of[j])
			                        - g[i] * g[j]);
}

/// From motions of, and moments about, the frame's origin to those of and about x: M − x × F, and u at the origin is u there − θ × x.
template <class R> POLYTOPE_INLINE void moveOrigin(const R* x, R (&slope)[6][6])
{
	for (int j = 0; j < 6; ++j) {
		const R force[3] = { slope[0][j], slope[1][j], slope[2][j] };
		R       turn[3]  = {};
		addCross<R, 3>(force, x, turn);
		for (int k = 0; k < 3; ++k)
			slope[3 + k][j] += turn[k];
	}
	for (int i = 0; i < 6; ++i)
		addCross<R, 3>(slope[i], x, slope[i] + 3);
}

/// What the next steps need, where the contact is one with the vertices of the last step and a direction. `x`: contact point.
template <class R, class Load>
POLYTOPE_APART void keepLinear(
        const PairQuery<R, 3>& q, const PairSurface<R, 3>& surface, const Load& load, const R* x, LinearContact& linear)
{
	using std::sqrt;
	const ContactFrame<R, 3>& f      = q.frame;
	const ContactResult&      out    = q.out;
	const bool                spring = q.settings.contactModel == ContactModel::Spring;
	R                         slope[6][6], moment[3] = {};
	slopeOfLoad<R>(spring, surface.sums, *surface.stiffness, slope);
	moveOrigin<R>(x, slope);
	addCross<R, 3>(x, load.force, moment);
	for (int k = 0; k < 3; ++k)
		moment[k] = load.moment[k] - moment[k];
	const R radius = sqrt(surface.stiffness->farthest) + norm<R, 3>(x), scale[2] = { 1, 1 / radius };

	// to body 1's axes, moments over the radius and rotations times it
	R    turned[6][6], force[3], turning[3];
	Real own[6][6];
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 6; ++j) {
			const R* const axis = f.own[0].m[j % 3];
			R              sum  = 0;
			for (int k = 0; k < 3; ++k)
				sum += slope[i][3 * (j / 3) + k] * axis[k];
			turned[i][j] = sum * scale[j / 3];
		}
	for (int j = 0; j < 6; ++j)
		for (int i = 0; i < 6; ++i) {
			const R* const axis = f.own[0].m[i % 3];
			R              sum  = 0;
			for (int k = 0; k < 3; ++k)
				sum += turned[3 * (i / 3) + k][j] * axis[k];
			own[i][j] = Real(sum * scale[i / 3]);
		}
	rotate<R, 3>(f.own[0], load.force, force);
	rotate<R, 3>(f.own[0], moment, turning);
	std::array<Real, 6> present;
	for (std::size_t k = 0; k < 3; ++k) {
		present[k]     = Real(force[k]);
		present[3 + k] = Real(turning[k] / radius);
	}
	linear.keep(
	        *q.in.rotation[0], *q.in.rotation[1], present, own, Real(surface.deepest), out.area, Real(radius), out.area / Real(radius));
	linear.energy  = surface.energy ? Real(load.energy) : Real(-1);
	linear.perArea = !spring;
	linear.carrier = f.home == 1;
}

} // namespace polytope
