// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactFrame.hpp"
#include "program/PairPlanes.hpp"

/// Planes of the bodies, given in their own axes, in the frame of the contact: one plane, or all into the rows of the pair.
namespace polytope {

/// Planes of a body into its rows: a ← Tᵀ·a, d ← (d − a·centre) − a·origin with the body's own a, in whose axes the frame's `centre` (of the smaller
/// body) and from there its `origin` are given: so a normal's rounding acts over the overlap only. T: from the frame to the body's axes.
template <class R, int D, int W>
POLYTOPE_INLINE void placePlanes(const PlacedPair& in, const ContactFrame<R, D>& f, int body, PairPlanes<R, D>& out)
{
	using V                      = typename Lanes<R, W>::Type;
	const ConvexShape&    shape  = *in.shape[body];
	const Rotation<R, D>& own    = f.own[body];
	const R *             centre = f.centre[body], *origin = f.origin[body];
	const int             begin = out.begin(body), end = out.end(body);
	V                     T[D][D], C[D], O[D];
	for (int j = 0; j < D; ++j) {
		C[j] = broadcast<R, W>(centre[j]);
		O[j] = broadcast<R, W>(origin[j]);
		for (int k = 0; k < D; ++k)
			T[j][k] = broadcast<R, W>(own.m[k][j]);
	}
	const R* source[D];
	for (int k = 0; k < D; ++k)
		source[k] = shape.normalArray(k);
	const R* offsets = shape.offsetArray();
	for (int i = 0; begin + i < end; i += W) {
		V a[D];
		V d = load<R, W>(offsets + i);
		for (int k = 0; k < D; ++k) {
			a[k] = load<R, W>(source[k] + i);
			d -= a[k] * C[k];
		}
		for (int k = 0; k < D; ++k)
			d -= a[k] * O[k];
		store<R, W>(out.offset + begin + i, d);
		for (int j = 0; j < D; ++j) {
			V moved = T[j][0] * a[0];
			for (int k = 1; k < D; ++k)
				moved += T[j][k] * a[k];
			store<R, W>(out.normal[j] + begin + i, moved);
		}
	}
}

/// A plane given in a body's own axes, in the frame.
template <class R, int D> POLYTOPE_INLINE void framePlane(const ContactFrame<R, D>& f, int body, const R* own, R offset, R* a, R& d)
{
	rotateBack<R, D>(f.own[body], own, a);
	d = (offset - dot<R, D>(own, f.centre[body])) - dot<R, D>(own, f.origin[body]);
}

/// One plane of a body in the frame.
template <class R, int D>
POLYTOPE_INLINE void framePlane(const PlacedPair& in, const ContactFrame<R, D>& f, int body, int index, R* a, R& d)
{
	R own[D];
	for (int k = 0; k < D; ++k)
		own[k] = in.shape[body]->normalArray(k)[index];
	framePlane<R, D>(f, body, own, R(in.shape[body]->offsetArray()[index]), a, d);
}

template <class R, int D, int W> POLYTOPE_INLINE void placePair(const PlacedPair& in, const ContactFrame<R, D>& f, PairPlanes<R, D>& planes)
{
	for (int body = 0; body < 2; ++body)
		placePlanes<R, D, W>(in, f, body, planes);
}

/// Does the same as placePair(), but in the smaller body's own frame, where its planes stay as they are.
template <class R, int D, int W>
POLYTOPE_INLINE void placePairAtHome(const PlacedPair& in, const ContactFrame<R, D>& f, PairPlanes<R, D>& planes)
{
	const ConvexShape& own   = *in.shape[f.home];
	const int          begin = planes.begin(f.home), count = own.paddedCount();
	for (int i = 0; i < count; i += W) {
		for (int k = 0; k < D; ++k)
			store<R, W>(planes.normal[k] + begin + i, load<R, W>(own.normalArray(k) + i));
		store<R, W>(planes.offset + begin + i, load<R, W>(own.offsetArray() + i));
	}
	placePlanes<R, D, W>(in, f, 1 - f.home, planes);
}

} // namespace polytope
