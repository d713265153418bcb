// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AnalyticCentre.hpp"
#include "ContactQuery.hpp"
#include "InnerPotential.hpp"
#include "OverlapCentroid.hpp"
#include "PenetrationDepth.hpp"
#include "SimplexLp.hpp"

#include <chrono>
#include <cmath>

/// The stages of one query in order, for one dimension D and lane width W. Included by ContactQuery.cpp alone, which
/// compiles it once per instruction set.
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

inline long nanoseconds()
{
	return long(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count());
}

template <class R, int D> POLYTOPE_INLINE ContactFrame<R, D> contactFrame(const PairInput& in)
{
	ContactFrame<R, D> f;
	f.home = in.shape[1]->boundingRadius() < in.shape[0]->boundingRadius() ? 1 : 0;
	f.size = in.shape[f.home]->boundingRadius();
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

/// Solves the basis given by codes (2 × index + body) in the home frame; false if it cannot serve.
template <class R, int D>
POLYTOPE_INLINE bool startFrom(const PairInput& in, const ContactFrame<R, D>& f, const std::array<int, 4>& codes, LpBasis<R, D>& basis, R* dual)
{
	R          normals[D + 1][D];
	const auto plane = [&](int k, R* a, R& d) POLYTOPE_INLINE_LAMBDA {
		homePlane<R, D>(in, f, codes[k] & 1, codes[k] >> 1, a, d);
		for (int j = 0; j < D; ++j)
			normals[k][j] = a[j];
	};
	if (!solveBasis<R, D>(plane, basis)) return false;
	for (int j = 0; j < D; ++j) {
		dual[j] = 0;
		for (int k = 0; k <= D; ++k)
			dual[j] += R((codes[k] & 1) == 0) * basis.weight[k] * normals[k][j];
	}
	return true;
}

/// n_λ = Σ over body 1 of λ_k a_k in the planes' frame.
template <class R, int D> POLYTOPE_INLINE void dualDirection(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, R* dual)
{
	for (int j = 0; j < D; ++j) {
		dual[j] = 0;
		for (int k = 0; k <= D; ++k)
			dual[j] += R(basis.plane[k] < planes.first) * basis.weight[k] * planes.normal[j][basis.plane[k]];
	}
}

template <class R, int D> POLYTOPE_INLINE R norm(const R* v)
{
	using std::sqrt;
	return sqrt(dot<R, D>(v, v));
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

/// Goes from x (inside) towards `target` as far as it stays inside.
template <class R, int D, int W> POLYTOPE_INLINE void moveInside(const PairPlanes<R, D>& planes, R* x, const R* target)
{
	using V = typename Lanes<R, W>::Type;
	V X[D], step[D];
	for (int k = 0; k < D; ++k) {
		X[k]    = broadcast<R, W>(x[k]);
		step[k] = broadcast<R, W>(target[k] - x[k]);
	}
	V largest = broadcast<R, W>(R(tolerance::interiorStep));
	for (int i = 0; i < planes.total; i += W) {
		V rate  = load<R, W>(planes.normal[0] + i) * step[0];
		V slack = load<R, W>(planes.offset + i) - load<R, W>(planes.normal[0] + i) * X[0];
		for (int k = 1; k < D; ++k) {
			const V a = load<R, W>(planes.normal[k] + i);
			rate += a * step[k];
			slack -= a * X[k];
		}
		largest = maxOf(largest, V(rate / slack));
	}
	// largest = 1/t_max where a plane is met before the target
	const R t = R(tolerance::interiorStep) / -horizontalMin<R, W>(-largest);
	if (!(t > 0)) return;
	for (int k = 0; k < D; ++k)
		x[k] += t * (target[k] - x[k]);
}

template <class R, int D> POLYTOPE_INLINE bool finite(const Vector3& v)
{
	using std::isfinite;
	return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/// Normal at x (Eq. 17) from both gradients, or what stands in for it. Leaves slacks for the depth.
template <class R, int D, int W>
POLYTOPE_INLINE ContactStatus contactNormal(
        const PairInput& in, const ContactSettings& settings, const PairPlanes<R, D>& planes, const ContactFrame<R, D>& f, const R* x, const R* dual, R* n)
{
	R         weight[2];
	R         g[2][D];
	int       directed = 0;
	for (int body = 0; body < 2; ++body) {
		innerPotentialGradient<R, D, W>(planes, body, x, in.shape[body]->cornerRadius(), g[body]);
		const R length = norm<R, D>(g[body]);
		const bool has = length > R(tolerance::direction) * f.size;
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
	if (directed == 0 || !(length > R(tolerance::direction) * (directed == 2 ? settings.normalWeight[0] + settings.normalWeight[1] : R(0)))) {
		status = ContactStatus::NormalFromDual;
		for (int k = 0; k < D; ++k)
			n[k] = dual[k];
		length = norm<R, D>(n);
	}
	if (!(length > R(tolerance::direction) * R(directed == 0))) {
		// concentric bodies: along the line of centres, or the last axis
		status   = ContactStatus::NoDirection;
		R line[D];
		for (int k = 0; k < D; ++k)
			line[k] = f.home == 0 ? f.centre[k] : -f.centre[k];
		rotate<R, D>(f.axes, line, n);
		length = norm<R, D>(n);
		if (!(length > R(tolerance::direction) * f.size)) {
			for (int k = 0; k < D; ++k)
				n[k] = f.axes.m[k][D - 1];
			length = norm<R, D>(n);
		}
	}
	for (int k = 0; k < D; ++k)
		n[k] /= length;
	return status;
}

template <class R, int D> POLYTOPE_INLINE void rememberBasis(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, PairMemory& memory, ContactResult& out)
{
	for (int k = 0; k <= D; ++k) {
		const bool second = basis.plane[k] >= planes.first;
		memory.basis[k]   = 2 * (basis.plane[k] - (second ? planes.first : 0)) + second;
		out.weights[k]    = basis.weight[k];
	}
	memory.hasBasis = true;
	out.basis       = memory.basis;
}

template <class R, int D> POLYTOPE_INLINE PairPlanes<R, D> pairRows(const PairInput& in, ContactWorkspace& workspace)
{
	PairPlanes<R, D> planes;
	planes.first = in.shape[0]->paddedCount();
	planes.total = planes.first + in.shape[1]->paddedCount();
	R* row       = workspace.rows(D + 3, planes.total);
	for (int k = 0; k < D; ++k)
		planes.normal[k] = row + k * planes.total;
	planes.offset = row + D * planes.total;
	planes.slack  = row + (D + 1) * planes.total;
	planes.rate   = row + (D + 2) * planes.total;
	return planes;
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
	const R        length = norm<R, D>(direction);
	R              n[D];
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
		placePlanes<R, D, W>(
		        *in.shape[body], home ? f.axes : turn, home ? nowhere : centre, home ? f.origin : origin, planes, planes.begin(body), planes.end(body));
	}
}

template <class R, int D, int W>
POLYTOPE_INLINE void
contactKernel(const PairInput& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	const long         started   = settings.timed ? nanoseconds() : 0;
	ContactFrame<R, D> f         = contactFrame<R, D>(in);
	const R            tolerance = settings.tolerance * f.size;
	const R            dismiss   = settings.geometryAcrossGap ? R(padOffset) : -tolerance;
	// no point of the overlap is farther from any plane (a wall's only plane: than the body is wide)
	const R larger = in.shape[1 - f.home]->boundingRadius();
	const R reach  = 2 * (larger < R(padOffset) ? larger : f.size);

	// 1. a first basis: the last step's, or the smaller inscribed ball's
	LpBasis<R, D> basis;
	R             dual[D];
	const bool    warm = settings.warmStart && memory.hasBasis && startFrom<R, D>(in, f, memory.basis, basis, dual) && dualFeasible<R, D>(basis);
	if (!warm) {
		int ball        = in.shape[1]->inscribedRadius() < in.shape[0]->inscribedRadius() ? 1 : 0;
		memory.hasPoint = memory.hasBasis = false;
		// the other one, where turning a basis of nearly parallel planes has made it singular
		for (int attempt = 0; attempt < 2 && !memory.hasBasis; ++attempt, ball = 1 - ball) {
			if (!(in.shape[ball]->inscribedRadius() < R(padOffset))) continue;
			for (int k = 0; k <= D; ++k)
				memory.basis[k] = 2 * in.shape[ball]->inscribedBasis()[k] + ball;
			memory.hasBasis = startFrom<R, D>(in, f, memory.basis, basis, dual);
		}
		if (!memory.hasBasis) {
			out.status        = ContactStatus::Failed;
			out.infeasibility = basis.infeasibility;
			return;
		}
	}
	if (lowerBound<R, D>(basis, reach) > dismiss) {
		out.status        = ContactStatus::Separated;
		out.infeasibility = basis.infeasibility;
		out.dismissed     = true;
		memory.hasPoint   = false;
		return;
	}

	// 2. all planes, in a frame turned and moved by what that basis knows
	// (its point may be far outside both bodies: there every plane would lose digits)
	PairPlanes<R, D> planes = pairRows<R, D>(in, workspace);
	const R          away   = maxOf<R>(1, norm<R, D>(basis.point) / f.size);
	R                origin[D];
	for (int k = 0; k < D; ++k)
		origin[k] = basis.point[k] / away;
	const Rotation<R, D> turn = aim<R, D>(f, dual, origin);
	placePair<R, D, W>(in, f, planes);
	for (int k = 0; k <= D; ++k)
		basis.plane[k] = (memory.basis[k] >> 1) + ((memory.basis[k] & 1) ? planes.first : 0);

	// 3. LP
	LpStatus lp = LpStatus::PivotLimit;
	if (moveBasis<R, D>(planes, turn, origin, -R(tolerance::thin) * f.size, basis)) {
		const int limit = maxOf<int>(tolerance::pivotsAtLeast, tolerance::pivotsPerPlane * planes.total);
		lp              = solveLp<R, D, W>(planes, basis, f.size, dismiss, reach, limit, out.simplexPivots);
		rememberBasis<R, D>(planes, basis, memory, out);
	}
	const long lpDone = settings.timed ? nanoseconds() : 0;
	out.lpNanoseconds = lpDone - started;
	out.infeasibility = basis.infeasibility;
	const bool touching = basis.infeasibility < -tolerance;
	dualDirection<R, D>(planes, basis, dual);
	out.dualDirection = worldDirection<R, D>(in, f, dual);
	if (!touching && !settings.geometryAcrossGap) {
		out.status      = lp == LpStatus::PivotLimit ? ContactStatus::LpNotConverged : ContactStatus::Separated;
		memory.hasPoint = false;
		return;
	}
	out.inContact   = touching;
	out.hasGeometry = true;

	// 4. the frame for the centre: turned to the optimum's dual direction, origin at the LP's point
	R x[D];
	for (int k = 0; k < D; ++k)
		x[k] = basis.point[k];
	// (where the overlap is thick, the frame of the first basis does: its digits are enough)
	if (out.simplexPivots > 0 && !(basis.infeasibility < -R(tolerance::thin) * f.size)) {
		const Rotation<R, D> turn = aim<R, D>(f, dual, x);
		placePair<R, D, W>(in, f, planes);
		R turned[D];
		rotate<R, D>(turn, dual, turned);
		for (int k = 0; k < D; ++k) {
			dual[k] = turned[k];
			x[k]    = 0;
		}
	}
	// a separated pair gets the point, normal and section it would have if both bodies were grown until they just overlap
	R grown = 0;
	if (!touching) {
		grown = basis.infeasibility + R(tolerance::gapSkin) * f.size;
		for (int i = 0; i < planes.total; ++i)
			planes.offset[i] += grown;
	}

	// 5. contact point
	ContactStatus outcome = touching ? ContactStatus::Contact : ContactStatus::Separated;
	if (lp == LpStatus::PivotLimit) outcome = ContactStatus::LpNotConverged;
	else if (settings.contactPoint == ContactPoint::AnalyticCentre) {
		R start[D], target[D];
		for (int k = 0; k < D; ++k)
			start[k] = x[k];
		if (settings.warmStart && memory.hasPoint) {
			R carried[2][D];
			for (int body = 0; body < 2; ++body)
				fromBody<R, D>(f, body, memory.point[body], carried[body]);
			for (int k = 0; k < D; ++k)
				target[k] = (carried[0][k] + carried[1][k]) / 2;
		} else
			simplexCentre<R, D>(basis, x, target);
		moveInside<R, D, W>(planes, start, target);
		// what is left of the way to the centre moves the depth by at most that part of itself
		const R            deep   = touching ? -basis.infeasibility : R(tolerance::gapSkin) * f.size;
		const R            accept = minOf<R>(settings.newtonTolerance, R(tolerance::depth) * f.size / deep);
		CentreStatus       centre;
		for (int turns = 0;; ++turns) {
			centre = analyticCentre<R, D, W>(planes, start, accept, out.newtonIterations, out.decrement);
			if (centre != CentreStatus::Skewed || turns == tolerance::turns) break;
			const Rotation<R, D> turn = stiffAxes<R, D>(planes);
			turnPlanes<R, D, W>(turn, planes);
			turnFrame<R, D>(f, turn);
			R* const turned[] = { start, x, dual };
			for (R* v : turned) {
				R old[D];
				for (int k = 0; k < D; ++k)
					old[k] = v[k];
				rotate<R, D>(turn, old, v);
			}
		}
		if (centre == CentreStatus::NotConverged || centre == CentreStatus::Skewed) outcome = ContactStatus::CentreNotConverged;
		else {
			if (centre == CentreStatus::RoundingLimited && touching) outcome = ContactStatus::RoundingLimited;
			for (int k = 0; k < D; ++k)
				x[k] = start[k];
		}
	} else if (settings.contactPoint == ContactPoint::Centroid) {
		overlapCentroid<R, D>(planes, x, 2 * f.size, workspace.polygons(4 * (planes.total + 5)));
	}

	if (settings.timed) out.centreNanoseconds = nanoseconds() - lpDone;

	// 6. normal and depth
	R                   n[D];
	const ContactStatus normal = contactNormal<R, D, W>(in, settings, planes, f, x, dual, n);
	if (outcome == ContactStatus::Contact) outcome = normal;
	if (touching) out.depth = exitDistance<R, D, W>(planes, 0, n, 1) + exitDistance<R, D, W>(planes, 1, n, -1);
	else {
		// where the normal is no way out the chord says nothing; the bodies are s*/|n_λ| apart at the least
		const R apart = maxOf<R>(basis.infeasibility, 0) / maxOf<R>(norm<R, D>(dual), R(tolerance::direction));
		out.depth     = minOf<R>(exitOfGrown<R, D>(planes, 0, n, 1, grown) + exitOfGrown<R, D>(planes, 1, n, -1, grown), -apart);
	}

	out.status = outcome;
	out.normal = worldDirection<R, D>(in, f, n);
	out.point  = worldPoint<R, D>(in, f, x);
	for (int body = 0; body < 2; ++body)
		toBody<R, D>(f, body, x, memory.point[body]);
	memory.hasPoint = true;

	// 7. contact section, for laws that ask for it
	if (settings.section) {
		const Section<R, D> section = clipPlane(planes, x, n, 2 * f.size, workspace.polygons(4 * (planes.total + 5)), -1);
		out.area                    = section.area;
		if (D == 2) out.area *= minOf<R>(in.shape[0]->thickness(), in.shape[1]->thickness());
		out.sectionCentroid = worldPoint<R, D>(in, f, section.centroid);
	}
	using std::isfinite;
	if (!finite<R, D>(out.point) || !finite<R, D>(out.normal) || !isfinite(out.depth)) {
		out.status      = ContactStatus::Failed;
		out.inContact   = false;
		out.hasGeometry = false;
		memory.hasBasis = memory.hasPoint = false;
	}
}

} // namespace polytope
