// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairPlanes.hpp"
#include "Tolerances.hpp"

#include <array>
#include <cmath>

/// The frame one query computes in, and the ways between it, the bodies' own frames and world axes.
namespace polytope {

struct PairInput {
	const ConvexShape* shape[2];
	const Matrix3*     rotation[2];
	const Vector3*     centre2;
};

/// The frame of one query. It starts in the body frame of the smaller body (so that no coordinate is large against the
/// contact), then its origin goes to the LP's point and its last axis along the LP's dual direction.
template <class R, int D> struct ContactFrame {
	int            home;      ///< body whose frame `origin` is given in
	R              size;      ///< that body's circumradius
	Rotation<R, D> other;     ///< rotation from the other body's frame to home's
	R              centre[D]; ///< the other body's centre in home's frame
	Rotation<R, D> axes;      ///< rows: the frame's axes in home's frame
	R              origin[D];
};

template <class R, int D> POLYTOPE_INLINE R norm(const R* v)
{
	using std::sqrt;
	return sqrt(dot<R, D>(v, v));
}

template <class R, int D> POLYTOPE_INLINE ContactFrame<R, D> contactFrame(const PairInput& in)
{
	ContactFrame<R, D> f;
	f.home              = in.shape[1]->boundingRadius() < in.shape[0]->boundingRadius() ? 1 : 0;
	f.size              = in.shape[f.home]->boundingRadius();
	const Matrix3& h    = *in.rotation[f.home];
	const Matrix3& o    = *in.rotation[1 - f.home];
	const R        sign = f.home == 0 ? R(1) : R(-1);
	for (int j = 0; j < D; ++j) {
		f.centre[j] = 0;
		for (int i = 0; i < D; ++i)
			f.centre[j] += h(i, j) * sign * (*in.centre2)[i];
		for (int k = 0; k < D; ++k) {
			f.other.m[j][k] = 0;
			for (int i = 0; i < D; ++i)
				f.other.m[j][k] += h(i, j) * o(i, k);
			f.axes.m[j][k] = j == k;
		}
		f.origin[j] = 0;
	}
	return f;
}

/// One plane of a body in the home frame.
template <class R, int D> POLYTOPE_INLINE void homePlane(const PairInput& in, const ContactFrame<R, D>& f, int body, int index, R* a, R& d)
{
	R own[D];
	for (int k = 0; k < D; ++k)
		own[k] = in.shape[body]->normalArray(k)[index];
	d = in.shape[body]->offsetArray()[index];
	if (body == f.home) {
		for (int k = 0; k < D; ++k)
			a[k] = own[k];
	} else {
		rotate<R, D>(f.other, own, a);
		d += dot<R, D>(a, f.centre);
	}
}

/// From the planes' frame to world axes (direction).
template <class R, int D> POLYTOPE_INLINE Vector3 worldDirection(const PairInput& in, const ContactFrame<R, D>& f, const R* v)
{
	R home[D];
	rotateBack<R, D>(f.axes, v, home);
	const Matrix3& h = *in.rotation[f.home];
	Vector3        out(0, 0, 0);
	for (int i = 0; i < D; ++i)
		for (int j = 0; j < D; ++j)
			out[i] += h(i, j) * home[j];
	return out;
}

/// From the planes' frame to world axes from body 1's centre (point).
template <class R, int D> POLYTOPE_INLINE Vector3 worldPoint(const PairInput& in, const ContactFrame<R, D>& f, const R* x)
{
	R home[D];
	rotateBack<R, D>(f.axes, x, home);
	const Matrix3& h = *in.rotation[f.home];
	Vector3        out(0, 0, 0);
	for (int i = 0; i < D; ++i) {
		for (int j = 0; j < D; ++j)
			out[i] += h(i, j) * (home[j] + f.origin[j]);
		if (f.home == 1) out[i] += (*in.centre2)[i];
	}
	return out;
}

/// A body's own coordinates of a point given in the planes' frame, and back.
template <class R, int D> POLYTOPE_INLINE void toBody(const ContactFrame<R, D>& f, int body, const R* x, Vector3& out)
{
	R home[D], own[D];
	rotateBack<R, D>(f.axes, x, home);
	for (int k = 0; k < D; ++k)
		home[k] += f.origin[k];
	if (body != f.home) {
		for (int k = 0; k < D; ++k)
			home[k] -= f.centre[k];
		rotateBack<R, D>(f.other, home, own);
	}
	for (int k = 0; k < D; ++k)
		out[k] = body == f.home ? home[k] : own[k];
	for (int k = D; k < 3; ++k)
		out[k] = 0;
}

template <class R, int D> POLYTOPE_INLINE void fromBody(const ContactFrame<R, D>& f, int body, const Vector3& own, R* out)
{
	R v[D], home[D];
	for (int k = 0; k < D; ++k)
		v[k] = own[k];
	if (body == f.home) {
		for (int k = 0; k < D; ++k)
			home[k] = v[k] - f.origin[k];
	} else {
		rotate<R, D>(f.other, v, home);
		for (int k = 0; k < D; ++k)
			home[k] += f.centre[k] - f.origin[k];
	}
	rotate<R, D>(f.axes, home, out);
}

/// Turns the frame's axes about its origin.
template <class R, int D> POLYTOPE_INLINE void turnFrame(ContactFrame<R, D>& f, const Rotation<R, D>& turn)
{
	const Rotation<R, D> old = f.axes;
	for (int j = 0; j < D; ++j)
		for (int k = 0; k < D; ++k) {
			f.axes.m[j][k] = 0;
			for (int i = 0; i < D; ++i)
				f.axes.m[j][k] += turn.m[j][i] * old.m[i][k];
		}
}

/// Turns the frame: last axis along `direction` (if it has one), origin to x; both in the planes' frame.
template <class R, int D> POLYTOPE_INLINE Rotation<R, D> aim(ContactFrame<R, D>& f, const R* direction, const R* x)
{
	const R length = norm<R, D>(direction);
	R       n[D];
	for (int k = 0; k < D; ++k)
		n[k] = length > R(tolerance::direction) ? direction[k] / length : R(k == D - 1);
	const Rotation<R, D> turn = axesAround<R, D>(n);
	R                    move[D];
	rotateBack<R, D>(f.axes, x, move);
	turnFrame<R, D>(f, turn);
	for (int k = 0; k < D; ++k)
		f.origin[k] += move[k];
	return turn;
}

template <class R, int D, int W> POLYTOPE_INLINE void placePair(const PairInput& in, const ContactFrame<R, D>& f, PairPlanes<R, D>& planes)
{
	const R        nowhere[D] = {};
	R              centre[D], origin[D];
	Rotation<R, D> turn;
	rotateBack<R, D>(f.other, f.centre, centre);
	rotateBack<R, D>(f.other, f.origin, origin);
	for (int j = 0; j < D; ++j)
		for (int k = 0; k < D; ++k) {
			turn.m[j][k] = 0;
			for (int i = 0; i < D; ++i)
				turn.m[j][k] += f.axes.m[j][i] * f.other.m[i][k];
		}
	for (int body = 0; body < 2; ++body) {
		const bool home = body == f.home;
		placePlanes<R, D, W>(*in.shape[body], home ? f.axes : turn, home ? nowhere : centre, home ? f.origin : origin, planes,
		        planes.begin(body), planes.end(body));
	}
}

/// A point that both bodies carry along, in the planes' frame: half-way between where each has taken it. `own`: in each body's frame.
template <class R, int D> POLYTOPE_INLINE void carriedPoint(const ContactFrame<R, D>& f, const std::array<Vector3, 2>& own, R* out)
{
	R carried[2][D];
	for (int body = 0; body < 2; ++body)
		fromBody<R, D>(f, body, own[body], carried[body]);
	for (int k = 0; k < D; ++k)
		out[k] = (carried[0][k] + carried[1][k]) / 2;
}

/// v ← T·v
template <class R, int D> POLYTOPE_INLINE void turnVector(const Rotation<R, D>& turn, R* v)
{
	R old[D];
	for (int k = 0; k < D; ++k)
		old[k] = v[k];
	rotate<R, D>(turn, old, v);
}

} // namespace polytope
