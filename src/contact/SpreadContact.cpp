// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SpreadContact.hpp"

#include "contact/CoreFeatures.hpp"
#include "numbers/PlaneAxes.hpp"
#include "shape/Rings.hpp"
#include "shear/ContactOutline.hpp"

#include <algorithm>
#include <limits>

namespace polytope {

namespace {

	/// Sums over a pair of features, h over δ.
	struct SpreadSums {
		Real    h1 = 0, h2 = 0, h3 = 0;
		Vector2 place1 = Vector2::Zero(), place2 = Vector2::Zero();

		void add(const Real& weight, const Vector2& place, const Real& h)
		{
			h1 += weight * h;
			h2 += weight * h * h;
			h3 += weight * h * h * h;
			place1 += weight * h * place;
			place2 += weight * h * h * place;
		}
	};

	/// A place along the plane normal to the normal, and h over δ there.
	struct SpreadPlace {
		Vector2 at;
		Real    h;
	};

	SpreadPlace operator+(const SpreadPlace& one, const SpreadPlace& other) { return { one.at + other.at, one.h + other.h }; }
	SpreadPlace operator-(const SpreadPlace& one, const SpreadPlace& other) { return { one.at - other.at, one.h - other.h }; }
	SpreadPlace operator*(const Real& times, const SpreadPlace& one) { return { times * one.at, times * one.h }; }

	SpreadPlace between(const SpreadPlace& one, const SpreadPlace& other, const Real& part) { return one + part * (other - one); }

	/// What a convex ring leaves where a function of its places is not negative.
	template <class Value> void clip(std::vector<SpreadPlace>& ring, std::vector<SpreadPlace>& buffer, const Value& value)
	{
		buffer.clear();
		keepAbove(ring, value, buffer);
		ring.swap(buffer);
	}

	/// Over a triangle, to the third power exactly (corners 3/60, middles of sides 8/60, centre 27/60).
	void addTriangle(const SpreadPlace& a, const SpreadPlace& b, const SpreadPlace& c, SpreadSums& sums)
	{
		const Vector2 u = b.at - a.at, v = c.at - a.at;
		const Real    area = cross(u, v) / 2;
		const auto    add  = [&](const Real& part, const SpreadPlace& place) { sums.add(part * area / 60, place.at, place.h); };
		for (const SpreadPlace* corner : { &a, &b, &c })
			add(3, *corner);
		for (const auto& [one, other] : { std::pair(&a, &b), std::pair(&b, &c), std::pair(&c, &a) })
			add(8, between(*one, *other, Real(0.5)));
		add(27, { (a.at + b.at + c.at) / 3, (a.h + b.h + c.h) / 3 });
	}

	/// By Simpson's rule, to the third power exactly.
	void addLine(const SpreadPlace& one, const SpreadPlace& other, SpreadSums& sums)
	{
		const Real length = (other.at - one.at).norm();
		for (const auto& [part, weight] : { std::pair(0, 1), std::pair(1, 4), std::pair(2, 1) }) {
			const SpreadPlace place = between(one, other, Real(part) / 2);
			sums.add(weight * length / 6, place.at, place.h);
		}
	}

	/// All pairs of features of two cores that a normal joins.
	class Spread {
	public:
		Spread(const CoreInPlace& core1, const CoreInPlace& core2, const Vector3& normal, const Vector3& nearest,
		        const Real& deepest)
		        : one_(core1, normal), other_(core2, -normal), normal_(normal), nearest_(nearest), deepest_(deepest), axes_(normal)
		{
		}

		SpreadContact contact()
		{
			std::vector<SpreadPlace> shared;
			meetFaces(shared);
			meetEdgeAndFace(one_, other_, 1);
			meetEdgeAndFace(other_, one_, -1);
			meetEdges();
			if (shared.empty()) shared = line_;
			SpreadContact result { deepest_ * (1 - less_), slope_, Vector3::Zero(), {} };
			const Vector3 aside = axes_.inSpace(arm_) + deepest_ * normal_.cross(turn_);
			result.point        = nearest_ + aside / slope_;
			const Vector2 from(aside.dot(axes_.u) / slope_, aside.dot(axes_.v) / slope_);
			for (const SpreadPlace& corner : shared)
				result.outline.push_back(corner.at - from);
			return result;
		}

	private:
		CoreFeatures   one_, other_;
		const Vector3 &normal_, &nearest_;
		const Real     deepest_;
		PlaneAxes      axes_;
		Real           less_ = 0, slope_ = 1;
		Vector2        arm_  = Vector2::Zero();
		Vector3        turn_ = Vector3::Zero(); ///< moment on body 2 about the nearest point, over k D δ
		/// Where the pair of features with an edge that weighs most touches.
		std::vector<SpreadPlace> line_;
		Real                     weightOfLine_ = 0;

		void offerLine(const Real& weight, const SpreadPlace& one, const SpreadPlace& other)
		{
			if (!(weight > weightOfLine_)) return;
			weightOfLine_ = weight;
			line_         = { one, other };
		}

		Vector2 across(const Vector3& place) const { return Vector2(axes_.u.dot(place - nearest_), axes_.v.dot(place - nearest_)); }
		Real    height(const Vector3& place) const { return normal_.dot(place - nearest_); }
		/// Height of a feature's face over a place of the plane.
		Real height(const CoreFeatures& features, const Vector2& at) const
		{
			const Vector3 place = nearest_ + axes_.inSpace(at);
			return features.faceNormal.dot(features.onFace - place) / features.faceNormal.dot(normal_);
		}

		/// Turns the gaps of a pair of features, which h holds so far, into h over δ: the depth is δ where the gap is least.
		void fromGaps(std::vector<std::vector<SpreadPlace>>& parts) const
		{
			Real least = std::numeric_limits<Real>::infinity();
			for (const auto& places : parts)
				for (const SpreadPlace& place : places)
					least = std::min(least, place.h);
			for (auto& places : parts)
				for (SpreadPlace& place : places)
					place.h = 1 - (place.h - least) / deepest_;
		}

		/// \param more how the weight changes as body 2 turns, and body 1 does not
		void take(const Real& weight, const Vector3& more, const SpreadSums& sums)
		{
			if (!(sums.h2 > 0)) return;
			const Real mean = sums.h3 / sums.h2, slope = 3 - 2 * mean * sums.h1 / sums.h2;
			less_ += weight * (1 - mean);
			slope_ -= weight * (1 - slope);
			arm_ += weight * (3 * sums.place2 - 2 * mean * sums.place1) / sums.h2;
			turn_ += (1 - mean) * more;
		}

		/// \param shared where both faces touch: of pieces, the first
		void meetFaces(std::vector<SpreadPlace>& shared)
		{
			const Real weight = one_.face.value * other_.face.value;
			if (!(weight > 0)) return;
			const CoreFeatures &bounded = one_.faces.empty() ? other_ : one_, &bounding = one_.faces.empty() ? one_ : other_;
			std::vector<std::vector<SpreadPlace>> rings;
			std::vector<SpreadPlace>              buffer;
			for (const FaceCorners& face : bounded.faces) {
				std::vector<SpreadPlace> ring;
				for (const Vector3& corner : face)
					ring.push_back({ across(corner), 0 });
				// counter-clockwise about its own outward normal
				if (&bounded == &other_) std::reverse(ring.begin(), ring.end());
				if (bounding.faces.empty()) rings.push_back(std::move(ring));
				else
					for (const FaceCorners& over : bounding.faces) {
						rings.push_back(ring);
						clipByFace(rings.back(), buffer, over, &bounding == &one_ ? 1 : -1);
					}
			}
			for (auto& ring : rings)
				for (SpreadPlace& place : ring)
					place.h = height(other_, place.at) - height(one_, place.at);
			fromGaps(rings);
			SpreadSums sums;
			for (auto& ring : rings) {
				clip(ring, buffer, [](const SpreadPlace& place) { return place.h; });
				for (std::size_t k = 2; k < ring.size(); ++k)
					addTriangle(ring[0], ring[k - 1], ring[k], sums);
			}
			if (!(sums.h2 > 0)) return;
			if (rings.front().size() > 2) shared = rings.front();
			take(weight, one_.face.value * other_.face.turn - other_.face.value * one_.face.turn, sums);
		}

		/// What lies over a face. `sense`: 1 where its corners go counter-clockwise about the normal.
		void clipByFace(
		        std::vector<SpreadPlace>& places, std::vector<SpreadPlace>& buffer, const FaceCorners& face, int sense) const
		{
			const std::size_t count = face.size();
			if (count < 3) places.clear();
			for (std::size_t k = 0; k < count && !places.empty(); ++k) {
				const Vector2 from = across(face[k]), way = across(face[(k + 1) % count]) - from;
				clip(places, buffer, [&](const SpreadPlace& place) { return sense * cross(way, place.at - from); });
			}
		}

		/// \param sense 1 where the edge is body 1's
		void meetEdgeAndFace(const CoreFeatures& edge, const CoreFeatures& face, int sense)
		{
			const Real left = 1 - edge.face.value, weight = left * edge.edge.value * face.face.value;
			if (!(weight > 0)) return;
			const std::vector<SpreadPlace>        whole { { across(edge.ends[0]), height(edge.ends[0]) },
				       { across(edge.ends[1]), height(edge.ends[1]) } };
			std::vector<SpreadPlace>              buffer;
			std::vector<std::vector<SpreadPlace>> parts;
			if (face.faces.empty()) parts.push_back(whole);
			for (const FaceCorners& over : face.faces) {
				std::vector<SpreadPlace> ends = whole;
				clipByFace(ends, buffer, over, -sense);
				if (ends.size() < 2) ends.clear();
				parts.push_back(std::move(ends));
			}
			for (auto& ends : parts)
				for (SpreadPlace& place : ends)
					place.h = sense * (height(face, place.at) - place.h);
			fromGaps(parts);
			SpreadSums sums;
			for (auto& ends : parts) {
				clip(ends, buffer, [](const SpreadPlace& place) { return place.h; });
				if (ends.size() < 2) continue;
				addLine(ends[0], ends[1], sums);
				if (&ends == &parts.front()) offerLine(weight, ends[0], ends[1]);
			}
			const Vector3 ofEdge = face.face.value * (left * edge.edge.turn - edge.edge.value * edge.face.turn),
			              ofFace = left * edge.edge.value * face.face.turn;
			take(weight, sense * (ofFace - ofEdge), sums);
		}

		void meetEdges()
		{
			const Real left1 = 1 - one_.face.value, left2 = 1 - other_.face.value;
			if (!(left1 * left2 * one_.edge.value * other_.edge.value > 0)) return;
			const Vector3 way1 = one_.ends[1] - one_.ends[0], way2 = other_.ends[1] - other_.ends[0];
			const Vector3 along = way1.normalized();
			Real          change;
			const Real    parallel = parallelism(along.cross(way2.normalized()).squaredNorm(), change);
			if (!(parallel > 0)) return;
			// places of both by their way along edge 1
			const Real length = way1.norm(), start = along.dot(other_.ends[0] - one_.ends[0]),
			           end = along.dot(other_.ends[1] - one_.ends[0]);
			const Real low = std::max(Real(0), std::min(start, end)), high = std::min(length, std::max(start, end));
			if (!(low < high)) return;
			const auto apart = [&](const Real& place) -> Vector3 {
				return other_.ends[0] + (place - start) / (end - start) * way2 - one_.ends[0] - place * along;
			};
			// the square of the distance is a parabola along them: the part where it is less than δ more than its least
			const Vector3 first = apart(low), rate = (apart(high) - first) / (high - low);
			const Real    turn = rate.squaredNorm();
			const Real    least
			        = turn > 0 ? std::min(std::max(Real(-first.dot(rate) / turn), Real(0)), Real(high - low)) : Real(0);
			const Real nearest = (first + least * rate).norm(), most = nearest + deepest_;
			const auto until = [&](const Real& bound) {
				// (first + t rate)² = most²
				const Real middle = -first.dot(rate) / turn;
				const Real room   = most * most - (first + middle * rate).squaredNorm();
				const Real far    = room > 0 ? Real(sqrt(room / turn)) : Real(0);
				return bound > least ? std::min(bound, Real(middle + far)) : std::max(bound, Real(middle - far));
			};
			const Real from = turn > 0 ? until(0) : Real(0), to = turn > 0 ? until(high - low) : high - low;
			const auto placeAt = [&](const Real& place) {
				const Vector3 way = first + place * rate;
				return SpreadPlace { across(one_.ends[0] + (low + place) * along + way / 2),
					1 - (way.norm() - nearest) / deepest_ };
			};
			SpreadSums sums;
			// Gauss with four places
			static constexpr double places[]
			        = { 0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629 },
			        weights[] = { 0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693 };
			for (int k = 0; k < 4; ++k) {
				const SpreadPlace place = placeAt(from + Real(places[k]) * (to - from));
				sums.add(Real(weights[k]) * (to - from), place.at, place.h);
			}
			offerLine(left1 * left2 * one_.edge.value * other_.edge.value * parallel, placeAt(from), placeAt(to));
			const Vector3 of1 = left1 * one_.edge.turn - one_.edge.value * one_.face.turn,
			              of2 = left2 * other_.edge.turn - other_.edge.value * other_.face.turn;
			take(left1 * left2 * one_.edge.value * other_.edge.value * parallel,
			        parallel * (left1 * one_.edge.value * of2 - left2 * other_.edge.value * of1), sums);
		}
	};

} // namespace

SpreadContact spreadContact(
        const CoreInPlace& core1, const CoreInPlace& core2, const Vector3& normal, const Vector3& nearest, const Real& deepest)
{
	return Spread(core1, core2, normal, nearest, deepest).contact();
}

} // namespace polytope
