// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PlacedPair.hpp"
#include "numbers/Rotation.hpp"
#include "numbers/Tolerances.hpp"

#include <cmath>

/// The frame in which one query computes, and transformations between it, the bodies' own frames and world axes.
namespace polytope {

/// The frame of one query, given in each body's own axes: so a plane that passes near the contact loses no digits through its
/// body's size or position. It is that of the last step's contact (followContact()) or starts in the smaller
/// body (homeFrame()) and goes on to the LP's point, last axis along the LP's dual direction (aim()).
template <class R, int D> struct ContactFrame {
	int            home;         ///< the smaller body
	R              size;         ///< its circumradius
	Rotation<R, D> world;        ///< from the frame to world axes
	Rotation<R, D> own[2];       ///< from the frame to a body's axes
	R              origin[2][D]; ///< vector from the smaller body's centre to the frame's origin, in a body's axes
	R              centre[2][D]; ///< the smaller body's centre in a body's coordinates
};

/// Bᵀ·v, B a body's rotation: from world axes to the body's.
template <class R, int D, class V> POLYTOPE_INLINE void toOwnAxes(const Matrix3& rotation, const V& v, R* out)
{
	for (int k = 0; k < D; ++k) {
		out[k] = rotation(0, k) * v[0];
		for (int i = 1; i < D; ++i)
			out[k] += rotation(i, k) * v[i];
	}
}

template <class R, int D, class V> POLYTOPE_INLINE void toWorldAxes(const Matrix3& rotation, const V& v, R* out)
{
	for (int i = 0; i < D; ++i) {
		out[i] = rotation(i, 0) * v[0];
		for (int k = 1; k < D; ++k)
			out[i] += rotation(i, k) * v[k];
	}
}

/// The frame's axes in a body's, from those in the world's.
template <class R, int D, int W> POLYTOPE_INLINE Rotation<R, D> ownAxes(const Matrix3& rotation, const Rotation<R, D>& world)
{
	return product<R, D, W>([&](int j, int i) POLYTOPE_INLINE_LAMBDA -> R { return rotation(i, j); }, world);
}

/// Axes (columns: the frame's in world axes) for a frame whose origin stays.
template <class R, int D, int W> POLYTOPE_INLINE void setAxes(const PlacedPair& in, ContactFrame<R, D>& f, const Rotation<R, D>& world)
{
	f.world = world;
	for (int body = 0; body < 2; ++body)
		f.own[body] = ownAxes<R, D, W>(*in.rotation[body], world);
}

/// Whether all components of the pose are finite.
template <class R, int D> POLYTOPE_INLINE bool finitePose(const PlacedPair& in)
{
	using std::isfinite;
	R all = 0;
	for (int j = 0; j < D; ++j) {
		all += (*in.centre2)[j];
		for (int k = 0; k < D; ++k)
			all += (*in.rotation[0])(j, k) + (*in.rotation[1])(j, k);
	}
	return isfinite(all);
}

/// `home` and `size` alone.
template <class R, int D> POLYTOPE_INLINE ContactFrame<R, D> unplacedFrame(const PlacedPair& in)
{
	ContactFrame<R, D> f;
	f.home = in.shape[1]->boundingRadius() < in.shape[0]->boundingRadius() ? 1 : 0;
	f.size = in.shape[f.home]->boundingRadius();
	return f;
}

template <class R, int D> POLYTOPE_INLINE void setCentres(const PlacedPair& in, ContactFrame<R, D>& f)
{
	const int other = 1 - f.home;
	toOwnAxes<R, D>(*in.rotation[other], *in.centre2, f.centre[other]);
	for (int k = 0; k < D; ++k) {
		f.centre[other][k]  = f.home == 0 ? -f.centre[other][k] : f.centre[other][k];
		f.centre[f.home][k] = 0;
	}
}

/// The smaller body's own frame.
template <class R, int D, int W> POLYTOPE_INLINE void homeFrame(const PlacedPair& in, ContactFrame<R, D>& f)
{
	const int      other = 1 - f.home;
	const Matrix3& h     = *in.rotation[f.home];
	for (int k = 0; k < D; ++k) {
		for (int j = 0; j < D; ++j) {
			f.world.m[j][k]       = h(j, k);
			f.own[f.home].m[j][k] = j == k;
		}
		f.origin[0][k] = f.origin[1][k] = 0;
	}
	f.own[other] = ownAxes<R, D, W>(*in.rotation[other], f.world);
}

/// From the planes' frame to world axes (direction).
template <class R, int D> POLYTOPE_INLINE Vector3 worldDirection(const ContactFrame<R, D>& f, const R* v)
{
	R out[3] = { 0, 0, 0 };
	rotate<R, D>(f.world, v, out);
	return Vector3(out[0], out[1], out[2]);
}

/// A body's own coordinates of a point given in the planes' frame, and back.
template <class R, int D> POLYTOPE_INLINE Vector3 toBody(const ContactFrame<R, D>& f, int body, const R* x)
{
	R out[3] = { 0, 0, 0 };
	rotate<R, D>(f.own[body], x, out);
	for (int k = 0; k < D; ++k)
		out[k] = (out[k] + f.origin[body][k]) + f.centre[body][k];
	return Vector3(out[0], out[1], out[2]);
}

template <class R, int D> POLYTOPE_INLINE void fromBody(const ContactFrame<R, D>& f, int body, const Vector3& own, R* out)
{
	R away[D];
	for (int k = 0; k < D; ++k)
		away[k] = (own[k] - f.centre[body][k]) - f.origin[body][k];
	rotateBack<R, D>(f.own[body], away, out);
}

/// From the smaller body's coordinates to world axes from body 1's centre.
template <class R, int D> POLYTOPE_INLINE Vector3 worldPoint(const PlacedPair& in, const ContactFrame<R, D>& f, const Vector3& home)
{
	R out[3] = { 0, 0, 0 };
	toWorldAxes<R, D>(*in.rotation[f.home], home, out);
	for (int k = 0; k < D; ++k)
		out[k] += f.home == 1 ? R((*in.centre2)[k]) : R(0);
	return Vector3(out[0], out[1], out[2]);
}

/// Turns the frame's axes about its origin.
template <class R, int D, int W> POLYTOPE_INLINE void turnFrame(ContactFrame<R, D>& f, const Rotation<R, D>& turn)
{
	const Rotation<R, D> back   = transposed<R, D>(turn);
	const auto           turned = [&](Rotation<R, D>& t) POLYTOPE_INLINE_LAMBDA {
                const Rotation<R, D> old = t;
                t = product<R, D, W>([&](int j, int i) POLYTOPE_INLINE_LAMBDA -> R { return old.m[j][i]; }, back);
	};
	turned(f.world);
	turned(f.own[0]);
	turned(f.own[1]);
}

/// Turns the frame: last axis along `direction` (if it has one), origin to x; both in the planes' frame.
template <class R, int D, int W> POLYTOPE_INLINE Rotation<R, D> aim(ContactFrame<R, D>& f, const R* direction, const R* x)
{
	const R length = norm<R, D>(direction);
	R       n[D];
	for (int k = 0; k < D; ++k)
		n[k] = length > R(tolerance::direction) ? direction[k] / length : R(k == D - 1);
	const Rotation<R, D> turn = axesAround<R, D>(n);
	for (int body = 0; body < 2; ++body) {
		R move[D];
		rotate<R, D>(f.own[body], x, move);
		for (int k = 0; k < D; ++k)
			f.origin[body][k] += move[k];
	}
	turnFrame<R, D, W>(f, turn);
	return turn;
}

} // namespace polytope
