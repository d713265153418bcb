// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearStrength.hpp"

#include "shear/ShearTolerances.hpp"

namespace polytope {
namespace {

	/// The gradient of a linear function over the outline with this resultant and this offset of its centre from the centroid: J g = total × offset.
	/// Across a sliver nothing is known of it.
	Vector2 gradientOf(const OutlineMoments& moments, Real total, const Vector2& offset)
	{
		const Real    mean = (moments.second[0] + moments.second[2]) / 2, half = (moments.second[0] - moments.second[2]) / 2;
		const Real    radius = sqrt(half * half + moments.second[1] * moments.second[1]), largest = mean + radius;
		const Vector2 along = half > 0 ? Vector2(half + radius, moments.second[1]) : Vector2(moments.second[1], radius - half);
		const Vector2 axis  = radius > 0 ? Vector2(along.normalized()) : Vector2(1, 0);
		// mean − radius loses the digits of a narrow outline
		const Real least
		        = largest > 0 ? (moments.second[0] * moments.second[2] - moments.second[1] * moments.second[1]) / largest : Real(0);
		Vector2 result = Vector2::Zero();
		if (largest > 0) result += total * offset.dot(axis) / largest * axis;
		if (least > Real(tolerance::shearSliver) * largest) result += total * offset.dot(left(axis)) / least * left(axis);
		return result;
	}

} // namespace

/// Integrals of (1), about the pole c.
struct ShearStrength::Sums {
	Vector2 radial   = Vector2::Zero(); ///< ∫ τ r̂ dA
	Real    distance = 0;               ///< ∫ τ |r| dA
	Real    tensor[3] { 0, 0, 0 };      ///< ∫ τ r̂ r̂ᵀ/|r| dA
};

ShearStrength::ShearStrength(const Vector2* corner, int count, const OutlineMoments& moments, Real total, const Vector2& centre)
        : corner_(corner), count_(count), total_(total), centre_(centre)
{
	const Vector2 offset = centre - moments.centroid;
	gradient_            = gradientOf(moments, total, offset);
	const Real mean      = total / moments.area;
	Real       lowest    = 0;
	for (int k = 0; k < count; ++k) {
		const Real change = gradient_.dot(corner[k] - moments.centroid);
		if (change < lowest) lowest = change;
	}
	const Real share = -lowest > mean ? mean / -lowest : Real(1);
	gradient_ *= share;
	// the strength's own centre; where that is not the one asked for, the outline is moved there
	const Vector2 own = moments.centroid + share * offset;
	shift_            = -own;
	atCentre_         = mean + gradient_.dot(own - moments.centroid);
	for (int k = 0; k < count; ++k) {
		const Vector2 from = this->corner(k), to = this->corner(k + 1 < count ? k + 1 : 0), middle = (from + to) / 2;
		farthest_ = from.norm() > farthest_ ? from.norm() : farthest_;
		addSecond(from, 1, cross(from, to));
		addSecond(middle, 4, cross(from, to));
		addSecond(to, 1, cross(from, to));
	}
	for (Real& second : second_)
		second /= total;
	leastRadius_ = farthest_ > 0 ? (second_[0] + second_[2]) / farthest_ : Real(0);
}

/// What a point of an edge adds to the moments of the triangle between it and the centre, by Simpson's rule, which is exact for cubics.
void ShearStrength::addSecond(const Vector2& x, Real weight, Real twice)
{
	const Real strength = weight / 6 * twice * (atCentre_ / 4 + gradient_.dot(x) / 5);
	for (int m = 0; m < 3; ++m)
		second_[m] += strength * x[m / 2] * x[(m + 1) / 2];
}

Real ShearStrength::meanRadius() const
{
	Sums sums;
	for (int k = 0; k < count_; ++k)
		addEdge(corner(k), corner(k + 1 < count_ ? k + 1 : 0), atCentre_, sums);
	return sums.distance / total_;
}

/// The triangle between the pole, where τ would be `atPole`, and an edge, whose ends are seen from there.
void ShearStrength::addEdge(const Vector2& from, const Vector2& to, Real atPole, Sums& sums) const
{
	using std::log;
	const Real length = (to - from).norm();
	if (!(length > 0)) return;
	const Vector2 e = (to - from) / length, m = -left(e); // outwards of a pole inside
	const Real    h = from.dot(m), y1 = from.dot(e), y2 = to.dot(e);
	const Real    r1 = from.norm(), r2 = to.norm();
	if (!(abs(h) > Real(tolerance::shearPole) * length) || !(r1 > 0 && r2 > 0)) return;
	// asinh(y₂/|h|) − asinh(y₁/|h|), without loss of digits where both are negative
	const auto arc = [&](Real y, Real r) { return y >= 0 ? log((y + r) / abs(h)) : -log((r - y) / abs(h)); };
	const Real i0  = arc(y2, r2) - arc(y1, r1);
	const Real i1  = r2 - r1;
	const Real i2  = (y2 * r2 - y1 * r1 - h * h * i0) / 2;
	const Real j0  = (y2 * r2 - y1 * r1 + h * h * i0) / 2;                                       // ∫ ρ dy
	const Real j1  = (r2 * r2 * r2 - r1 * r1 * r1) / 3;                                          // ∫ ρ y dy
	const Real k0 = y2 / r2 - y1 / r1, k1 = 1 / r1 - 1 / r2, k2 = i0 - k0, k3 = i1 - h * h * k1; // h² ∫ 1/ρ³, ∫ y/ρ³, ∫ y²/ρ³, ∫ y³/ρ³
	const Real gm = gradient_.dot(m), ge = gradient_.dot(e);

	const Real a = atPole / 2 + gm * h / 3, b = ge / 3;
	sums.radial += h * (h * (a * i0 + b * i1) * m + (a * i1 + b * i2) * e);
	sums.distance += h * ((atPole / 3 + gm * h / 4) * j0 + ge / 4 * j1);
	const Real p = atPole + gm * h / 2, q = ge / 2;
	const Real mm = h * (p * k0 + q * h * h * k1), me = h * h * (p * k1 + q * k2), ee = h * (p * k2 + q * k3);
	for (int k = 0; k < 3; ++k) {
		const int i = k / 2, j = (k + 1) / 2;
		sums.tensor[k] += mm * m[i] * m[j] + me * (m[i] * e[j] + e[i] * m[j]) + ee * e[i] * e[j];
	}
}

/// The sums of (1) at points in the triangles between the centre and the edges: the direction of slip changes little over the outline.
Vector3 ShearStrength::byPoints(const Vector3& slip, Matrix3* slope) const
{
	// Gauss-Legendre with three points on 0 … 1
	static const Real root = sqrt(Real(15)) / 10, place[3] = { Real(0.5) - root, Real(0.5), Real(0.5) + root },
	                  weight[3] = { Real(5) / 18, Real(8) / 18, Real(5) / 18 };
	Vector3 result              = Vector3::Zero();
	if (slope) slope->setZero();
	for (int k = 0; k < count_; ++k) {
		const Vector2 from = corner(k), along = corner(k + 1 < count_ ? k + 1 : 0) - from;
		const Real    twice = cross(from, along);
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j) {
				const Vector2 x = place[i] * (from + place[j] * along), v = slip.head<2>() + slip[2] * left(x);
				const Real    share = weight[i] * weight[j] * place[i] * twice * at(x), speed = v.norm();
				const Vector2 d = v / speed, across = left(d);
				result += share * Vector3(d[0], d[1], cross(x, d));
				if (!slope) continue;
				const Vector3 h(across[0], across[1], cross(x, across));
				*slope += share / speed * h * h.transpose();
			}
	}
	return result;
}

Vector3 ShearStrength::resistance(const Vector3& slip, Matrix3* slope) const
{
	const Vector2 s      = slip.head<2>();
	const Real    length = s.norm(), turn = slip[2];
	Vector3       result = Vector3::Zero();
	if (slope) slope->setZero();
	if (!(length > 0) && turn == 0) return result;
	if (length >= Real(tolerance::shearPoleFar) * farthest_ * abs(turn)) return byPoints(slip, slope);
	const Vector2 pole   = left(s) / turn; // v = 0 there
	const Real    atPole = at(pole);
	Sums          sums;
	for (int k = 0; k < count_; ++k)
		addEdge(corner(k) - pole, corner(k + 1 < count_ ? k + 1 : 0) - pole, atPole, sums);
	const Real sign = turn > 0 ? Real(1) : Real(-1);
	result << sign * left(sums.radial), sign * (pole.dot(sums.radial) + sums.distance);
	if (slope) {
		Eigen::Matrix<Real, 2, 2> t;
		t << sums.tensor[0], sums.tensor[1], sums.tensor[1], sums.tensor[2];
		t /= abs(turn);
		const Vector2 arm = left(pole), moved = t * arm;
		slope->topLeftCorner<2, 2>() = t;
		(*slope)(0, 2) = (*slope)(2, 0) = moved[0];
		(*slope)(1, 2) = (*slope)(2, 1) = moved[1];
		(*slope)(2, 2)                  = arm.dot(moved);
	}
	return result;
}

} // namespace polytope
