// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/InnerPotential.hpp"
#include "contact/PairQuery.hpp"

/// Contact normal at the contact point: the average of two gradients (Boon et al. 2012, Eq. 17), and the direction that replaces it where
/// there is none.
namespace polytope {

/// Direction (not of unit length) where the bodies have none: along the line of centres, or the smaller body's last axis.
template <class R, int D> POLYTOPE_INLINE void lineOfCentres(const PlacedPair& in, const ContactFrame<R, D>& f, R* n)
{
	R line[D];
	for (int k = 0; k < D; ++k)
		line[k] = (*in.centre2)[k];
	rotateBack<R, D>(f.world, line, n);
	if (norm<R, D>(n) > R(tolerance::direction) * f.size) return;
	for (int k = 0; k < D; ++k)
		n[k] = f.own[f.home].m[D - 1][k];
}

/// Eq. 17 from both gradients (not of unit length); where a body has none the other's, where neither has the dual direction.
template <class R, int D, int W> POLYTOPE_INLINE ContactStatus averagedNormal(const PairQuery<R, D>& q, R* n)
{
	const ContactSettings& settings = q.settings;

	R   weight[2];
	R   g[2][D];
	int directed = 0;
	for (int body = 0; body < 2; ++body) {
		innerPotentialGradient<R, D, W>(q.planes, body, q.x, q.in.shape[body]->cornerRadius(), g[body]);
		const R    length = norm<R, D>(g[body]);
		const bool has    = length > R(tolerance::direction) * q.frame.size;
		directed += has;
		weight[body] = has ? (body == 0 ? R(1) : R(-1)) * settings.normalWeight[body] / length : R(0);
	}
	for (int k = 0; k < D; ++k)
		n[k] = weight[0] * g[0][k] + weight[1] * g[1][k];
	R length = norm<R, D>(n);
	// a body of weight zero cannot be the only one that has a gradient
	if (directed == 1 && !(length > 0)) {
		const int body = norm<R, D>(g[0]) > norm<R, D>(g[1]) ? 0 : 1;
		for (int k = 0; k < D; ++k)
			n[k] = (body == 0 ? R(1) : R(-1)) * g[body][k];
		length = norm<R, D>(n);
	}
	ContactStatus status = directed == 2 ? ContactStatus::Contact : ContactStatus::NormalFromOneBody;
	if (directed == 0
	        || !(length > R(tolerance::direction) * (directed == 2 ? settings.normalWeight[0] + settings.normalWeight[1] : R(0)))) {
		status = ContactStatus::NormalFromDual;
		for (int k = 0; k < D; ++k)
			n[k] = q.dual[k];
		length = norm<R, D>(n);
	}
	return length > R(tolerance::direction) * R(directed == 0) ? status : ContactStatus::NoDirection;
}

/// Unit normal at the contact point. Leaves slacks for the depth.
template <class R, int D, int W> POLYTOPE_INLINE ContactStatus contactNormal(const PairQuery<R, D>& q, R* n)
{
	const ContactStatus status = averagedNormal<R, D, W>(q, n);
	if (status == ContactStatus::NoDirection) lineOfCentres<R, D>(q.in, q.frame, n);
	const R length = norm<R, D>(n);
	for (int k = 0; k < D; ++k)
		n[k] /= length;
	return status;
}

} // namespace polytope
