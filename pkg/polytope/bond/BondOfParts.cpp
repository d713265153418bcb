// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond/BondOfParts.hpp"

#include <src/bond/TensionFibres.hpp>

#include "bond/CommonFaceOfBodies.hpp"

#include <algorithm>

namespace yade {
namespace {

	/// One side of a bond in the world.
	struct Side {
		Vector3r    origin;
		Quaternionr axes;

		Side(const State& state, const Vector3r& point, const Quaternionr& frame)
		        : origin(state.pos + state.ori * point), axes(state.ori * frame)
		{
		}
	};

	/// Each fibre has the opening of the one of the whole that is nearest.
	/// \param place,turn of the part's axes in those of the whole
	std::vector<Real> openingsOfPart(
	        const PolytopeBond& whole, const PolytopeBond& part, const Vector3r& place, const Quaternionr& turn)
	{
		std::vector<Vector3r> places;
		polytope::forFibres(whole.corners, [&](const Vector3r& at, Real, std::size_t) { places.push_back(at); });
		std::vector<Real> openings;
		polytope::forFibres(part.corners, [&](const Vector3r& at, Real, std::size_t) {
			const Vector3r inWhole = place + turn * at;
			const auto     nearest = std::min_element(places.begin(), places.end(), [&](const Vector3r& a, const Vector3r& b) {
                                return (a - inWhole).squaredNorm() < (b - inWhole).squaredNorm();
                        });
			openings.push_back(whole.lastingOpenings[std::size_t(nearest - places.begin())]);
		});
		return openings;
	}

} // namespace

shared_ptr<PolytopeBond> bondOfParts(const PolytopeBond& whole, const Body& whole1, const Body& whole2, const Body& part1,
        const Body& part2, const BodyContainer& bodies)
{
	const Side side1(*whole1.state, whole.point1, whole.frame1), side2(*whole2.state, whole.point2, whole.frame2);
	const auto motion = polytope::bondMotion(side1.axes, side2.axes, side2.origin - side1.origin);
	// the area is the one that it was made with: where its two points are one
	const auto face = largestCommonFace(part1, part2, side1.origin - side2.origin, motion.mean * Vector3r::UnitX(),
	        polytope::deepestOverlap, math::cos(Real(polytope::tolerance::facingOfJoints)));
	if (!face) return nullptr;

	// the part's place and axes in the area of the whole
	Vector3r place          = motion.mean.conjugate() * (face->centroid - side1.origin);
	place[0]                = 0;
	const Vector3r    along = motion.mean.conjugate() * face->axes.col(1);
	const Quaternionr turn(AngleAxisr(math::atan2(along[2], along[1]), Vector3r::UnitX()));

	auto part = shared_ptr<PolytopeBond>(new PolytopeBond(whole));
	part->join(part1.id, part2.id, *face);
	part->adoptBodies(bodies, /*anew*/ true);
	part->attach(1, *part1.state, Vector3r::Zero(), side1.origin + side1.axes * place, side1.axes * turn);
	part->attach(2, *part2.state, Vector3r::Zero(), side2.origin + side2.axes * place, side2.axes * turn);
	if (whole.yields()) part->lastingOpenings = openingsOfPart(whole, *part, place, turn);
	part->follow(*part1.state, *part2.state, Vector3r::Zero());
	return part;
}

} // namespace yade
