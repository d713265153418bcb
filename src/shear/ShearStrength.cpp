// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearStrength.hpp"

#include "shear/StrengthIntegrals.hpp"

#include <limits>

namespace polytope {

namespace {

	/// The long axis of an outline.
	Vector2 longAxis(const OutlineMoments& moments)
	{
		const Real half     = (moments.second[0] - moments.second[2]) / 2,
		           radius   = sqrt(half * half + moments.second[1] * moments.second[1]);
		const Vector2 along = half > 0 ? Vector2(half + radius, moments.second[1]) : Vector2(moments.second[1], radius - half);
		return radius > 0 ? Vector2(along.normalized()) : Vector2(1, 0);
	}

	/// The gradient of a linear function over the outline with this resultant and this offset of its centre from the centroid: J g = total × offset.
	/// Across a sliver nothing is known of it.
	Vector2 gradientOf(const OutlineMoments& moments, const Vector2& axis, Real total, const Vector2& offset)
	{
		const Real mean = (moments.second[0] + moments.second[2]) / 2, half = (moments.second[0] - moments.second[2]) / 2;
		const Real largest = mean + sqrt(half * half + moments.second[1] * moments.second[1]);
		// mean − radius loses the digits of a narrow outline
		const Real least
		        = largest > 0 ? (moments.second[0] * moments.second[2] - moments.second[1] * moments.second[1]) / largest : Real(0);
		Vector2 result = Vector2::Zero();
		if (largest > 0) result += total * offset.dot(axis) / largest * axis;
		if (least > Real(tolerance::shearSliver) * largest) result += total * offset.dot(left(axis)) / least * left(axis);
		return result;
	}

} // namespace

ShearStrength::ShearStrength(const Vector2* corner, int count, const OutlineMoments& moments, Real total, const Vector2& centre)
        : corner_(corner), count_(count), total_(total), centre_(centre), axis_(longAxis(moments))
{
	const Vector2 offset = centre - moments.centroid;
	gradient_            = gradientOf(moments, axis_, total, offset);
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
	// the moments of the triangles between the edges and the centre, by Simpson's rule along the edges, which is exact for cubics
	Real       farthest = 0;
	const auto add      = [this](const Vector2& x, Real weight) {
                const Real strength = weight * (atCentre_ / 4 + gradient_.dot(x) / 5);
                second_[0] += strength * x[0] * x[0];
                second_[1] += strength * x[0] * x[1];
                second_[2] += strength * x[1] * x[1];
	};
	Vector2    from = this->corner(count - 1), to = this->corner(0);
	Real       twice      = cross(from, to);
	const Real twiceFirst = twice;
	for (int k = 0; k < count; ++k) {
		const Real before = twice;
		farthest          = to.squaredNorm() > farthest ? to.squaredNorm() : farthest;
		add((from + to) / 2, 4 * before);
		from  = to;
		to    = this->corner(k + 1 < count ? k + 1 : 0);
		twice = k + 1 < count ? cross(from, to) : twiceFirst;
		add(from, before + twice);
	}
	farthest_ = sqrt(farthest);
	for (Real& second : second_)
		second /= 6 * total;
	const Real byMoments = farthest_ > 0 ? (second_[0] + second_[2]) / farthest_ : Real(0), byArea = leastRadiusOnArea(moments.area);
	leastRadius_ = byMoments > byArea ? byMoments : byArea;
}

/// The outline's distance from the pole over its half width. Where that is large the triangles between it and the edges cancel: each is larger than the
/// outline by as much, and τ at the pole larger than on the outline by that once more.
Real ShearStrength::narrownessFrom(const Vector2& pole) const
{
	const Vector2 across = left(axis_);
	Vector2       least = Vector2::Zero(), most = Vector2::Zero();
	for (int k = 0; k < count_; ++k) {
		const Vector2 x(corner(k).dot(axis_), corner(k).dot(across));
		least = least.cwiseMin(x);
		most  = most.cwiseMax(x);
	}
	const Vector2 seen(pole.dot(axis_), pole.dot(across));
	const Real    width    = most[1] > -least[1] ? most[1] : -least[1];
	const Real    distance = (seen - seen.cwiseMax(least).cwiseMin(most)).norm();
	return width > 0 ? distance / width : std::numeric_limits<Real>::infinity();
}

SpreadStrength ShearStrength::spread() const
{
	return { corner_->data(), count_, { shift_[0], shift_[1] }, atCentre_, { gradient_[0], gradient_[1] } };
}

/// The direction of slip changes little over the outline; `precise`: not so little that three points do.
Vector3 ShearStrength::byPoints(const Vector3& slip, bool precise, Matrix3* slope) const
{
	const IntegralsAtPoints sums = strengthAtPoints(
	        spread(), { slip[0], slip[1], slip[2] }, precise ? GaussLegendre::five() : GaussLegendre::three(), slope);
	const Real(&all)[9] = sums.all;
	if (slope) *slope << all[3], all[4], all[6], all[4], all[5], all[7], all[6], all[7], all[8];
	return Vector3(all[0], all[1], all[2]);
}

Vector3 ShearStrength::resistance(const Vector3& slip, Matrix3* slope) const
{
	const Vector2 s      = slip.head<2>();
	const Real    length = s.norm(), turn = slip[2];
	Vector3       result = Vector3::Zero();
	if (slope) slope->setZero();
	if (!(length > 0) && turn == 0) return result;
	const Real near = farthest_ * abs(turn);
	if (length >= Real(tolerance::shearPoleFar) * near) return byPoints(slip, length < Real(tolerance::shearPoleFarther) * near, slope);
	const Vector2            pole   = left(s) / turn; // v = 0 there
	const Real               narrow = narrownessFrom(pole), c[2] { pole[0], pole[1] };
	const IntegralsAboutPole sums   = narrow > Real(tolerance::shearNarrow)
	          ? strengthAlongLines(spread(), { axis_[0], axis_[1] }, c, GaussLegendre::seenFrom(narrow))
	          : strengthOverTriangles(spread(), c);
	const Vector2            radial(sums.radial[0], sums.radial[1]);
	const Real               sign = turn > 0 ? Real(1) : Real(-1);
	result << sign * left(radial), sign * (pole.dot(radial) + sums.distance);
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
