// SPDX-License-Identifier: GPL-2.0-or-later
#include "timestep/ApproachLimit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polytope {
namespace {

	const Real infinite = std::numeric_limits<Real>::infinity();

	/// One body, or all bodies of a branch of the tree.
	struct Group {
		Vector3 low = Vector3::Constant(infinite), high = Vector3::Constant(-infinite);
		Vector3 slowest = Vector3::Constant(infinite), fastest = Vector3::Constant(-infinite); ///< of each component
		Real    spin = 0, radius = infinite;
		bool    free  = false;
		int     first = -1, second = -1; ///< its parts; of a single body its place in the list, and -1

		bool single() const { return second < 0; }
		void take(const Group& other)
		{
			low     = low.cwiseMin(other.low);
			high    = high.cwiseMax(other.high);
			slowest = slowest.cwiseMin(other.slowest);
			fastest = fastest.cwiseMax(other.fastest);
			spin    = std::max(spin, other.spin);
			radius  = std::min(radius, other.radius);
			free    = free || other.free;
		}
		Real extent() const { return (high - low).maxCoeff(); }
	};

	class Search {
	public:
		Search(std::vector<MovingBox> bodies, const Real& fraction, const Real& horizon, const Real& change, const Real& below,
		        const LimitOfTwo& limitOfTwo)
		        : bodies_(std::move(bodies)), fraction_(fraction), horizon_(horizon), change_(change), limitOfTwo_(limitOfTwo)
		{
			limit_.step = below;
		}

		ApproachLimit find()
		{
			std::vector<int> order, endless;
			for (int k = 0; k < int(bodies_.size()); ++k) {
				const MovingBox& body = bodies_[std::size_t(k)];
				(std::isfinite(double((body.high - body.low).sum())) ? order : endless).push_back(k);
			}
			groups_.reserve(2 * bodies_.size());
			std::vector<int> alone;
			for (int k : endless)
				alone.push_back(groupOf(k));
			const int root = order.empty() ? -1 : treeOf(order.data(), order.data() + order.size());
			for (std::size_t k = 0; k < alone.size(); ++k) {
				if (root >= 0) meet(alone[k], root);
				for (std::size_t j = 0; j < k; ++j)
					meet(alone[k], alone[j]);
			}
			if (root >= 0) meetWithin(root);
			return limit_.id >= 0 ? limit_ : ApproachLimit();
		}

	private:
		int groupOf(int place)
		{
			const MovingBox& body = bodies_[std::size_t(place)];
			// what a rotation adds to the box until then
			const Vector3 room
			        = Vector3::Constant(std::min(Real(body.spin * horizon_), Real((body.high - body.low).norm() / 2)));
			Group group;
			group.low     = body.low - room;
			group.high    = body.high + room;
			group.slowest = group.fastest = body.velocity;
			group.spin                    = body.spin;
			group.radius                  = body.radius;
			group.free                    = body.free;
			group.first                   = place;
			groups_.push_back(group);
			return int(groups_.size()) - 1;
		}

		int treeOf(int* begin, int* end)
		{
			if (end - begin == 1) return groupOf(*begin);
			const auto centre = [this](int k) { return Vector3(bodies_[std::size_t(k)].low + bodies_[std::size_t(k)].high); };
			Vector3    low = Vector3::Constant(infinite), high = Vector3::Constant(-infinite);
			for (const int* k = begin; k != end; ++k) {
				low  = low.cwiseMin(centre(*k));
				high = high.cwiseMax(centre(*k));
			}
			int axis = 0;
			(high - low).maxCoeff(&axis);
			int* const middle = begin + (end - begin) / 2;
			std::nth_element(begin, middle, end, [&](int a, int b) {
				const Real x = centre(a)[axis], y = centre(b)[axis];
				return x < y || (x == y && a < b);
			});
			Group group;
			group.first  = treeOf(begin, middle);
			group.second = treeOf(middle, end);
			group.take(groups_[std::size_t(group.first)]);
			group.take(groups_[std::size_t(group.second)]);
			groups_.push_back(group);
			return int(groups_.size()) - 1;
		}

		/// Highest speed of a point of one against one of the other.
		Real relativeSpeed(const Group& one, const Group& other) const
		{
			const Vector3 most = (one.fastest - other.slowest).cwiseMax(other.fastest - one.slowest);
			return most.norm() + one.spin + other.spin + (limitOfTwo_ ? change_ : Real(0));
		}

		/// Whether the boxes may overlap until the horizon: along each axis, at some time for a branch, at the same time for single bodies.
		bool mayMeet(const Group& one, const Group& other) const
		{
			const Real room  = change_ * horizon_;
			Real       enter = 0, leave = horizon_;
			for (int k = 0; k < 3; ++k) {
				const Real gap     = std::max(other.low[k] - one.high[k], one.low[k] - other.high[k]) - room;
				const bool above   = other.low[k] - one.high[k] > one.low[k] - other.high[k];
				const Real closing = above ? one.fastest[k] - other.slowest[k] : other.fastest[k] - one.slowest[k];
				if (gap > 0 && !(closing * horizon_ >= gap)) return false;
				if (!one.single() || !other.single()) continue;
				// from when to when they overlap along this axis
				const Real speed = other.slowest[k] - one.slowest[k];
				if (speed == 0) continue;
				const Real a = (one.low[k] - other.high[k] - room) / speed, b = (one.high[k] - other.low[k] + room) / speed;
				enter = std::max(enter, std::min(a, b));
				leave = std::min(leave, std::max(a, b));
			}
			return !(enter > leave);
		}

		void meet(int a, int b)
		{
			const Group &one = groups_[std::size_t(a)], &other = groups_[std::size_t(b)];
			if (!one.free && !other.free) return;
			const Real speed = relativeSpeed(one, other), way = fraction_ * std::min(one.radius, other.radius);
			if (!(way <= limit_.step * speed) || !(speed > 0) || !mayMeet(one, other)) return;
			if (one.single() && other.single()) {
				const int id1 = bodies_[std::size_t(one.first)].id, id2 = bodies_[std::size_t(other.first)].id;
				return take(limitOfTwo_ ? limitOfTwo_(id1, id2) : Real(way / speed), one, other);
			}
			if (other.single() || (!one.single() && one.extent() >= other.extent())) {
				const int first = one.first, second = one.second;
				meet(first, b);
				meet(second, b);
			} else {
				const int first = other.first, second = other.second;
				meet(a, first);
				meet(a, second);
			}
		}

		void meetWithin(int a)
		{
			const Group group = groups_[std::size_t(a)];
			if (group.single()) return;
			if (!(fraction_ * group.radius <= limit_.step * relativeSpeed(group, group))) return;
			meetWithin(group.first);
			meetWithin(group.second);
			meet(group.first, group.second);
		}

		void take(const Real& step, const Group& one, const Group& other)
		{
			const MovingBox &x = bodies_[std::size_t(one.first)], &y = bodies_[std::size_t(other.first)];
			const bool       first = x.free && (!y.free || x.radius < y.radius || (x.radius == y.radius && x.id < y.id));
			const int        id    = first ? x.id : y.id;
			if (step < limit_.step || (step == limit_.step && (limit_.id < 0 || id < limit_.id))) limit_ = { step, id };
		}

		std::vector<MovingBox> bodies_;
		std::vector<Group>     groups_;
		Real                   fraction_, horizon_, change_;
		const LimitOfTwo&      limitOfTwo_;
		ApproachLimit          limit_;
	};

} // namespace

ApproachLimit approachLimit(std::vector<MovingBox> bodies, const Real& fraction, const Real& horizon, const Real& change, const Real& below,
        const LimitOfTwo& limitOfTwo)
{
	return Search(std::move(bodies), fraction, horizon, change, below, limitOfTwo).find();
}

} // namespace polytope
