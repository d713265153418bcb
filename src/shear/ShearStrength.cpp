// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearStrength.hpp"

#include "numbers/InstructionSet.hpp"
#include "numbers/Lanes.hpp"
#include "shear/ShearTolerances.hpp"

#include <limits>

namespace polytope {

/// Places and weights of Gauss-Legendre quadrature on 0 … 1.
struct GaussLegendre {
	int  points;
	Real place[5], weight[5];

	static const GaussLegendre& two()
	{
		static const Real          root = sqrt(Real(3)) / 6, half = Real(0.5);
		static const GaussLegendre rule { 2, { half - root, half + root }, { half, half } };
		return rule;
	}
	static const GaussLegendre& three()
	{
		static const Real          root = sqrt(Real(15)) / 10, half = Real(0.5);
		static const GaussLegendre rule { 3, { half - root, half, half + root }, { Real(5) / 18, Real(8) / 18, Real(5) / 18 } };
		return rule;
	}
	static const GaussLegendre& five()
	{
		static const Real inner = sqrt(5 - 2 * sqrt(Real(10) / 7)) / 6, outer = sqrt(5 + 2 * sqrt(Real(10) / 7)) / 6,
		                  half = Real(0.5), light = (322 - 13 * sqrt(Real(70))) / 1800, heavy = (322 + 13 * sqrt(Real(70))) / 1800;
		static const GaussLegendre rule { 5, { half - outer, half - inner, half, half + inner, half + outer },
			{ light, heavy, Real(64) / 225, heavy, light } };
		return rule;
	}
	/// The rule with the fewest points that is exact to rounding on a line whose distance from the centre of rotation is so many times its length.
	static const GaussLegendre& seenFrom(Real lengths)
	{
		return lengths > Real(tolerance::shearTwoPoints) ? two() : lengths > Real(tolerance::shearThreePoints) ? three() : five();
	}
};

namespace {

	/// The long axis of an outline.
	Vector2 longAxis(const OutlineMoments& moments)
	{
		const Real half     = (moments.second[0] - moments.second[2]) / 2,
		           radius   = sqrt(half * half + moments.second[1] * moments.second[1]);
		const Vector2 along = half > 0 ? Vector2(half + radius, moments.second[1]) : Vector2(moments.second[1], radius - half);
		return radius > 0 ? Vector2(along.normalized()) : Vector2(1, 0);
	}

	/// Integrals along a line at the distance h from the pole, its points h m + y e from there with y from y₁ to y₂, ρ² = h² + y².
	struct LineIntegrals {
		Vector2 e, m;
		Real    length, h, y1;
		Real    y[4];         ///< ∫ yᵏ/ρ dy
		Real    rho[3];       ///< ∫ ρ yᵏ dy
		Real    overCubed[5]; ///< ∫ yᵏ/ρ³ dy

		/// The pole is not on the line between its ends.
		LineIntegrals(const Vector2& from, const Vector2& to) : length((to - from).norm())
		{
			using std::log;
			e             = (to - from) / length;
			m             = -left(e);
			h             = from.dot(m);
			y1            = from.dot(e);
			const Real y2 = to.dot(e), r1 = from.norm(), r2 = to.norm(), square = h * h;
			if (y1 >= 0) y[0] = log((y2 + r2) / (y1 + r1));
			else if (y2 <= 0) y[0] = log((r1 - y1) / (r2 - y2));
			else y[0] = log((y2 + r2) / abs(h)) + log((r1 - y1) / abs(h));
			y[1]   = r2 - r1;
			y[2]   = (y2 * r2 - y1 * r1 - square * y[0]) / 2;
			y[3]   = (r2 * r2 * r2 - r1 * r1 * r1) / 3 - square * y[1];
			rho[0] = y[2] + square * y[0];
			rho[1] = y[3] + square * y[1];
			rho[2] = (y2 * r2 * r2 * r2 - y1 * r1 * r1 * r1 - square * rho[0]) / 4;
			// y₂/r₂ − y₁/r₁ vanishes with h where the line points to the pole
			overCubed[0] = y1 * y2 > 0 ? (y2 - y1) * (y2 + y1) / (r1 * r2 * (y2 * r1 + y1 * r2)) : (y2 / r2 - y1 / r1) / square;
			overCubed[1] = 1 / r1 - 1 / r2;
			for (int k = 0; k < 3; ++k)
				overCubed[k + 2] = y[k] - square * overCubed[k];
		}
	};

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

/// Integrals of (1), about the pole c.
struct ShearStrength::Sums {
	Vector2 radial   = Vector2::Zero(); ///< ∫ τ r̂ dA
	Real    distance = 0;               ///< ∫ τ |r| dA
	Real    tensor[3] { 0, 0, 0 };      ///< ∫ τ r̂ r̂ᵀ/|r| dA
};

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
	leastRadius_ = farthest_ > 0 ? (second_[0] + second_[2]) / farthest_ : Real(0);
}

/// The triangle between the pole, where τ would be `atPole`, and an edge, whose ends are seen from there.
void ShearStrength::addEdge(const Vector2& from, const Vector2& to, Real atPole, Sums& sums) const
{
	const Real length = (to - from).norm();
	if (!(length > 0)) return;
	if (!(abs(cross(from, to)) > Real(tolerance::shearPole) * length * length) || !(from.squaredNorm() > 0 && to.squaredNorm() > 0))
		return;
	const LineIntegrals line(from, to);
	const Vector2 &     e = line.e, &m = line.m; // outwards of a pole inside
	const Real          h = line.h, square = h * h, gm = gradient_.dot(m), ge = gradient_.dot(e);

	const Real a = atPole / 2 + gm * h / 3, b = ge / 3;
	sums.radial += h * (h * (a * line.y[0] + b * line.y[1]) * m + (a * line.y[1] + b * line.y[2]) * e);
	sums.distance += h * ((atPole / 3 + gm * h / 4) * line.rho[0] + ge / 4 * line.rho[1]);
	const Real  p = atPole + gm * h / 2, q = ge / 2;
	const Real* c  = line.overCubed;
	const Real  mm = h * square * (p * c[0] + q * c[1]), me = square * (p * c[1] + q * c[2]), ee = h * (p * c[2] + q * c[3]);
	for (int k = 0; k < 3; ++k) {
		const int i = k / 2, j = (k + 1) / 2;
		sums.tensor[k] += mm * m[i] * m[j] + me * (m[i] * e[j] + e[i] * m[j]) + ee * e[i] * e[j];
	}
}

/// The outline's distance from the pole over its half width. Where that is large the triangles of addEdge() cancel: each is larger than the
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

/// The part of an outline between an edge and the long axis: exact along lines from end to end, those of `lines` across.
void ShearStrength::addStrip(const Vector2& from, const Vector2& to, const Vector2& pole, const GaussLegendre& lines, Sums& sums) const
{
	const Vector2 across = left(axis_);
	const Real    along1 = from.dot(axis_), along2 = to.dot(axis_), width1 = from.dot(across), width2 = to.dot(across);
	if (along1 == along2) return;
	for (int i = 0; i < lines.points; ++i) {
		const Vector2 x1 = along1 * axis_ + lines.place[i] * width1 * across,
		              x2 = along2 * axis_ + lines.place[i] * width2 * across;
		// the edges run against the axis where the outline is above it
		const Real whole = lines.weight[i] * (along1 - along2), far = (x1 - pole).norm() / Real(tolerance::shearShort);
		if ((x2 - x1).squaredNorm() < far * far) {
			const GaussLegendre& rule = GaussLegendre::seenFrom((x1 - pole).norm() / (x2 - x1).norm());
			for (int j = 0; j < rule.points; ++j) {
				const Vector2 x = x1 + rule.place[j] * (x2 - x1), r = x - pole;
				const Real    distance = r.norm(),
				           part = whole * rule.weight[j] * (width1 + rule.place[j] * (width2 - width1)) * at(x) / distance;
				sums.radial += part * r;
				sums.distance += part * distance * distance;
				for (int k = 0; k < 3; ++k)
					sums.tensor[k] += part / (distance * distance) * r[k / 2] * r[(k + 1) / 2];
			}
			continue;
		}
		const LineIntegrals line(x1 - pole, x2 - pole);
		const Real          share = whole / line.length;
		// width times τ, as q₀ + q₁ y + q₂ y²
		const Real w1 = (width2 - width1) / line.length, w0 = width1 - w1 * line.y1;
		const Real t1 = gradient_.dot(line.e), t0 = at(x1) - t1 * line.y1;
		const Real q[3] { share * w0 * t0, share * (w0 * t1 + w1 * t0), share * w1 * t1 };
		Real       radial[2] { 0, 0 }, tensor[3] { 0, 0, 0 };
		for (int k = 0; k < 3; ++k) {
			for (int power = 0; power < 2; ++power)
				radial[power] += q[k] * line.y[k + power];
			for (int power = 0; power < 3; ++power)
				tensor[power] += q[k] * line.overCubed[k + power];
			sums.distance += q[k] * line.rho[k];
		}
		const Vector2 &e = line.e, &m = line.m;
		const Real     h = line.h;
		sums.radial += radial[0] * h * m + radial[1] * e;
		for (int k = 0; k < 3; ++k) {
			const int a = k / 2, b = (k + 1) / 2;
			sums.tensor[k]
			        += tensor[0] * h * h * m[a] * m[b] + tensor[1] * h * (m[a] * e[b] + e[a] * m[b]) + tensor[2] * e[a] * e[b];
		}
	}
}

namespace {

	/// What the sums of (1) at points are made of, in plain numbers.
	struct PointSums {
		const Real*          corners; ///< u, v of each, from `shift`
		int                  count;
		Real                 shift[2], atCentre, gradient[2], slip[3];
		const GaussLegendre* rule;
		bool                 slope;  ///< whether its sums are wanted, too
		Real                 all[9]; ///< ∫ τ d, its moment, and the six of the slope
	};

	/// Several triangles between the centre and the edges at once.
	template <int width> POLYTOPE_INLINE void addAtPoints(PointSums& in)
	{
		using V             = typename Lanes<Real, width>::Type;
		V           sums[9] = {};
		auto        corner  = [&](int k, int m) POLYTOPE_INLINE_LAMBDA { return in.corners[2 * k + m] + in.shift[m]; };
		const auto& place   = in.rule->place;
		const auto& weight  = in.rule->weight;
		for (int k = 0; k < in.count; k += width) {
			Real rows[5][width]; // of a triangle that is not there: no area
			for (int t = 0; t < width; ++t) {
				const bool there = k + t < in.count;
				const int  one = there ? k + t : 0, two = there && k + t + 1 < in.count ? k + t + 1 : 0;
				for (int m = 0; m < 2; ++m) {
					rows[m][t]     = corner(one, m);
					rows[2 + m][t] = corner(two, m) - rows[m][t];
				}
				rows[4][t] = there ? rows[0][t] * rows[3][t] - rows[1][t] * rows[2][t] : Real(0);
			}
			const V from0 = load<Real, width>(rows[0]), from1 = load<Real, width>(rows[1]), along0 = load<Real, width>(rows[2]),
			        along1 = load<Real, width>(rows[3]), twice = load<Real, width>(rows[4]);
			for (int j = 0; j < in.rule->points; ++j) {
				const V edge0 = from0 + place[j] * along0, edge1 = from1 + place[j] * along1,
				        rise = in.gradient[0] * edge0 + in.gradient[1] * edge1;
				for (int i = 0; i < in.rule->points; ++i) {
					const V x0 = place[i] * edge0, x1 = place[i] * edge1;
					const V share = weight[i] * weight[j] * place[i] * twice * (in.atCentre + place[i] * rise);
					const V v0 = in.slip[0] - in.slip[2] * x1, v1 = in.slip[1] + in.slip[2] * x0,
					        speed = squareRoot<Real, width>(v0 * v0 + v1 * v1), d0 = v0 / speed, d1 = v1 / speed;
					sums[0] += share * d0;
					sums[1] += share * d1;
					sums[2] += share * (x0 * d1 - x1 * d0);
					if (!in.slope) continue;
					const V part = share / speed, arm = x0 * d0 + x1 * d1; // of the direction across
					sums[3] += part * d1 * d1;
					sums[4] -= part * d1 * d0;
					sums[5] += part * d0 * d0;
					sums[6] -= part * d1 * arm;
					sums[7] += part * d0 * arm;
					sums[8] += part * arm * arm;
				}
			}
		}
		horizontalSums<Real, width>(sums, in.all);
	}

	using AddAtPoints = void (*)(PointSums&);

#if defined(__x86_64__) && POLYTOPE_REAL_IS_DOUBLE
	__attribute__((target("arch=x86-64-v4"))) void addAtPointsV4(PointSums& in) { addAtPoints<4>(in); }
	__attribute__((target("arch=x86-64-v3"))) void addAtPointsV3(PointSums& in) { addAtPoints<4>(in); }
	void                                           addAtPointsV1(PointSums& in) { addAtPoints<4>(in); }

	AddAtPoints choose()
	{
		switch (instructionSetOfMachine()) {
			case InstructionSet::V4: return addAtPointsV4;
			case InstructionSet::V3: return addAtPointsV3;
			default: return addAtPointsV1;
		}
	}
#else
	AddAtPoints choose() { return addAtPoints<1>; }
#endif

	const AddAtPoints sumAtPoints = choose();

} // namespace

/// The sums of (1) at points in the triangles between the centre and the edges: the direction of slip changes little over the outline. So
/// little that it is a polynomial of low degree; `precise`: of one of higher degree.
Vector3 ShearStrength::byPoints(const Vector3& slip, bool precise, Matrix3* slope) const
{
	PointSums sums { corner_->data(), count_, { shift_[0], shift_[1] }, atCentre_, { gradient_[0], gradient_[1] },
		{ slip[0], slip[1], slip[2] }, precise ? &GaussLegendre::five() : &GaussLegendre::three(), slope != nullptr, {} };
	sumAtPoints(sums);
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
	const Vector2 pole   = left(s) / turn; // v = 0 there
	const Real    atPole = at(pole);
	const Real    narrow = narrownessFrom(pole);
	Sums          sums;
	for (int k = 0; k < count_; ++k) {
		const Vector2 from = corner(k), to = corner(k + 1 < count_ ? k + 1 : 0);
		if (narrow > Real(tolerance::shearNarrow)) addStrip(from, to, pole, GaussLegendre::seenFrom(narrow), sums);
		else addEdge(from - pole, to - pole, atPole, sums);
	}
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
