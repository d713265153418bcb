// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/RoundedSection.hpp"

#include "shape/DistanceTolerances.hpp"
#include "shape/Rings.hpp"
#include "shear/ContactOutline.hpp"

#include <algorithm>

namespace polytope {

namespace {

	/// The place of a body with a margin that is farthest along a unit vector.
	struct Farthest {
		const Vector3* vertex;
		Vector3        place;

		Farthest(const std::vector<Vector3>& core, const Real& margin, const Vector3& way)
		        : vertex(&*std::max_element(
		                  core.begin(), core.end(), [&](const Vector3& a, const Vector3& b) { return way.dot(a) < way.dot(b); })),
		          place(*vertex + margin * way)
		{
		}
	};

	/// A line of the plane that touches the section: out of it, how far that is from the plane's origin, and the vertex of the core behind it.
	struct Touch {
		Vector2        out;
		Real           reach;
		const Vector3* vertex;
	};

	class TouchedSection {
	public:
		TouchedSection(const std::vector<Vector3>& core, const Real& margin, const Vector3& normal, const PlaneAxes& axes,
		        const Vector3& at)
		        : core_(core), margin_(margin), normal_(normal), axes_(axes), at_(at), level_(normal.dot(at)),
		          lowest_(core, margin, -normal), highest_(core, margin, normal)
		{
		}

		bool isMissed() const { return !(normal_.dot(lowest_.place) < level_ && level_ < normal_.dot(highest_.place)); }

		Touch touch(const Vector2& out) const
		{
			const Vector3 d     = axes_.inSpace(out);
			Farthest      below = lowest_, above = highest_;
			Real          from = -quarter, to = quarter;
			// straight below and above, several vertices may be the farthest
			const auto isWithinOne = [&] { return from > -quarter && to < quarter && below.vertex == above.vertex; };
			for (int step = 0; step < tolerance::sectionSteps && !isWithinOne(); ++step) {
				const Real     middle = (from + to) / 2;
				const Farthest next(core_, margin_, Vector3(cos(middle) * d + sin(middle) * normal_));
				const bool     low    = normal_.dot(next.place) < level_;
				(low ? from : to)     = middle;
				(low ? below : above) = next;
			}
			if (isWithinOne() && margin_ > 0) {
				const Real sine = (level_ - normal_.dot(*below.vertex)) / margin_;
				return { out, d.dot(*below.vertex - at_) + margin_ * sqrt(std::max(Real(0), Real(1 - sine * sine))),
					below.vertex };
			} // else a face or an edge of the core lies between both
			const Real low = normal_.dot(below.place), high = normal_.dot(above.place);
			const Real part = high > low ? Real((level_ - low) / (high - low)) : Real(0);
			return { out, d.dot(below.place - at_) + part * d.dot(above.place - below.place), below.vertex };
		}

		/// The lines between two, counter-clockwise, that touch two vertices each, to so many vertices in between.
		void between(const Touch& one, const Touch& other, int most, std::vector<Touch>& all) const
		{
			if (one.vertex == other.vertex || most == 0) return;
			const Vector2 way    = across(*other.vertex) - across(*one.vertex), right(way[1], -way[0]);
			const Real    length = right.norm();
			if (!(length > 0)) return;
			const Vector2 out = right / length;
			if (!(cross(one.out, out) > 0 && cross(out, other.out) > 0)) return;
			const Touch middle = touch(out);
			all.push_back(middle);
			if (middle.vertex == one.vertex || middle.vertex == other.vertex) return;
			between(one, middle, most - 1, all);
			between(middle, other, most - 1, all);
		}

	private:
		const std::vector<Vector3>& core_;
		const Real                  margin_;
		const Vector3&              normal_;
		const PlaneAxes&            axes_;
		const Vector3&              at_;
		const Real                  level_, quarter = atan2(Real(1), Real(0));
		const Farthest              lowest_, highest_;

		Vector2 across(const Vector3& place) const { return Vector2(axes_.u.dot(place), axes_.v.dot(place)); }
	};

} // namespace

PlanePolygon roundedSection(
        const std::vector<Vector3>& core, const Real& margin, const Vector3& normal, const PlaneAxes& axes, const Vector3& at)
{
	const TouchedSection section(core, margin, normal, axes, at);
	if (section.isMissed()) return {};
	constexpr int      count = tolerance::sectionDirections;
	const Real         turn  = 4 * atan2(Real(1), Real(0)) / count;
	std::vector<Touch> all;
	for (int k = 0; k < count; ++k)
		all.push_back(section.touch(Vector2(cos(k * turn), sin(k * turn))));
	const Real   right = all[0].reach, top = all[count / 4].reach, left = all[count / 2].reach, down = all[3 * count / 4].reach;
	PlanePolygon polygon { { -left, -down }, { right, -down }, { right, top }, { -left, top } };
	for (int k = 0; k < count; ++k) {
		const Touch one = all[std::size_t(k)], other = all[std::size_t((k + 1) % count)];
		section.between(one, other, tolerance::sectionSides, all);
	}
	for (const Touch& line : all) {
		const Vector3 out = axes.inSpace(line.out);
		clipByPlane(polygon, { out, line.reach + out.dot(at) }, axes, at);
	}
	return polygon;
}

void clipByPlane(PlanePolygon& polygon, const Plane& plane, const PlaneAxes& axes, const Vector3& at)
{
	const Real    left = plane.offset - plane.normal.dot(at);
	const Vector2 slope(plane.normal.dot(axes.u), plane.normal.dot(axes.v));
	PlanePolygon  kept;
	keepAbove(polygon, [&](const Vector2& corner) { return Real(left - slope.dot(corner)); }, kept);
	polygon.swap(kept);
}

} // namespace polytope
