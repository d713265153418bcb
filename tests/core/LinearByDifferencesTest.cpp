// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/LinearByDifferences.hpp"
#include "ContactLoad.hpp"
#include "PairSamples.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

namespace {

constexpr ContactModel models[] = { ContactModel::Foundation, ContactModel::Spring };

/// The second body moved by `by` at x, and as far by its rotation at the distance `radius` from it.
Pair moved(Pair pair, const Vector3& x, Real by, Real radius, std::mt19937_64& random)
{
	const bool    flat = pair.dimension() == 2;
	const Real    way  = flat && random() % 2 ? Real(-by) : by;
	const Matrix3 turn = Eigen::AngleAxis<Real>(way / radius, flat ? Vector3::UnitZ() : randomDirection(random)).toRotationMatrix();
	pair.centre2       = turn * (pair.centre2 - x) + x + by * randomDirection(random, pair.dimension());
	pair.rotation[1]   = turn * pair.rotation[1];
	return pair;
}

/// One of two pieces of a slab, side by side in x, with the other one covering its face: which plane that is, and how far the slab goes on.
struct Piece {
	std::shared_ptr<const ConvexShape> shape = ConvexShape::shared(cuboid(1, 2, 1), 0);
	InternalPlanes                     covered;

	Piece()
	{
		for (int k = 0; k < shape->planeCount(); ++k)
			if (shape->planes().normals[std::size_t(k)][0] > Real(0.5)) {
				covered.add(0, k);
				covered.addEnd(0, { shape->planes().normals[std::size_t(k)], shape->planes().offsets[std::size_t(k)] + 2 });
			}
	}
};

} // namespace

/// Where there is a derivative in closed form, it is that one.
TEST(LinearByDifferences, IsTheDerivativeOfTheSurface)
{
	std::mt19937_64 random(2030);
	int             asked = 0;
	for (const ContactModel model : models)
		for (int trial = 0; trial < 60; ++trial) {
			const int       faces[] = { 4, 6, 8, 12, 20 };
			const Pair      pair    = regularPair(faces[trial % 5], faces[trial / 5 % 5], decades(random, -4, -2), random);
			ContactSettings settings;
			settings.contactModel = model;
			settings.energy       = false;
			PairMemory       memory;
			LinearContact    closed, differences;
			ContactWorkspace workspace;
			query(pair, settings, &memory);
			settings.linear            = &closed;
			const ContactResult result = query(pair, settings, &memory);
			if (!closed.known) continue;
			settings.linear = nullptr;
			linearByDifferences(pair.placed(), settings, memory, workspace, result, differences);
			ASSERT_TRUE(differences.known);
			EXPECT_EQ(differences.energy, -1);
			const Pair    there = moved(pair, result.point, closed.across / 3, differences.radius, random);
			ContactResult one, other;
			OutlineMotion outline;
			ASSERT_TRUE(closed.follow(there.placed(), settings, memory.point[0], memory.point[1], one, outline));
			ASSERT_TRUE(differences.follow(there.placed(), settings, memory.point[0], memory.point[1], other, outline));
			const ContactLoad a(one, model), b(other, model);
			EXPECT_LE((a.force - b.force).norm(), 1e-5 * a.force.norm());
			EXPECT_LE((a.moment - b.moment - result.point.cross(a.force - b.force)).norm(),
			        1e-5 * a.force.norm() * differences.radius);
			++asked;
		}
	EXPECT_GT(asked, 80);
}

/// A body on two pieces: what each of them has goes with the body's motion, to a part of 1e-4 of the force on both.
TEST(LinearByDifferences, FollowsAPartOfTheSurface)
{
	std::mt19937_64                      random(2031);
	std::uniform_real_distribution<Real> some(Real(-0.4), Real(0.4));
	const Piece                          piece;
	int                                  parts = 0, known = 0;
	for (const ContactModel model : models)
		for (int trial = 0; trial < 60; ++trial) {
			ContactSettings settings;
			settings.contactModel = model;
			settings.energy       = false;
			settings.internal     = &piece.covered;
			Pair       pair;
			const Real depth = decades(random, -5, -3);
			pair.shape[0]    = piece.shape;
			pair.shape[1]    = ConvexShape::shared(cuboid(Real(0.5), Real(0.4), Real(0.3)), 0);
			pair.rotation[1] = (Eigen::AngleAxis<Real>(depth * some(random), randomDirection(random))
			        * Eigen::AngleAxis<Real>(some(random), Vector3::UnitZ()))
			                           .toRotationMatrix();
			pair.centre2 = Vector3(1 + some(random), some(random), Real(1.3) - depth);
			PairMemory          memory;
			LinearContact       linear;
			ContactWorkspace    workspace;
			const ContactResult result = query(pair, settings, &memory);
			if (!(result.share > 0 && result.share < 1)) continue;
			++parts;
			linearByDifferences(pair.placed(), settings, memory, workspace, result, linear);
			if (!linear.known) continue;
			++known;
			const Real solid
			        = ContactLoad(result, model).force.norm() / (model == ContactModel::Foundation ? result.share : Real(1));
			for (int motion = 0; motion < 8; ++motion) {
				const Pair    there = moved(pair, result.point, linear.across / 3, linear.radius, random);
				ContactResult followed;
				OutlineMotion outline;
				ASSERT_TRUE(linear.follow(there.placed(), settings, memory.point[0], memory.point[1], followed, outline));
				const ContactResult full = query(there, settings);
				followed.depth *= model == ContactModel::Foundation ? Real(1) : result.share;
				ContactResult whole = full;
				whole.depth *= model == ContactModel::Foundation ? Real(1) : full.share;
				const ContactLoad one(followed, model), other(whole, model);
				EXPECT_LE((one.force - other.force).norm(), tolerance::linearLeftOut * solid);
				EXPECT_LE((one.moment - other.moment - result.point.cross(one.force - other.force)).norm(),
				        tolerance::linearLeftOut * solid * linear.radius);
			}
		}
	EXPECT_GT(parts, 80);
	EXPECT_GT(known, parts * 3 / 4);
}

/// Polygons of any thickness: faces, and corners on faces.
TEST(LinearByDifferences, FollowsPolygons)
{
	std::mt19937_64 random(2032);
	int             touching = 0, known = 0;
	for (const ContactModel model : models)
		for (int trial = 0; trial < 100; ++trial) {
			ContactSettings settings;
			settings.contactModel = model;
			settings.energy       = false;
			Pair       pair;
			const Real depth = decades(random, -5, -3);
			pair.shape[0]    = ConvexShape::shared(rectangle(1, Real(0.5)), 0, uniform(random, Real(0.1), 3));
			pair.shape[1]    = ConvexShape::shared(rectangle(Real(0.3), Real(0.2)), 0, uniform(random, Real(0.1), 3));
			// on a side, tilted by less and by more than the depth, or on a corner
			const Real tilt  = trial % 2 ? Real(uniform(random, -2, 2) * depth) : uniform(random, Real(-0.7), Real(0.7));
			pair.rotation[1] = Eigen::AngleAxis<Real>(tilt, Vector3::UnitZ()).toRotationMatrix();
			pair.centre2     = Vector3(uniform(random, Real(-0.5), Real(0.5)), 1, 0);
			moveTo(pair, Vector3::UnitY(), -depth / 2);
			PairMemory          memory;
			LinearContact       linear;
			ContactWorkspace    workspace;
			const ContactResult result = query(pair, settings, &memory);
			if (!result.inContact) continue;
			++touching;
			linearByDifferences(pair.placed(), settings, memory, workspace, result, linear);
			if (!linear.known) continue;
			++known;
			const Real size = ContactLoad(result, model).force.norm();
			for (int motion = 0; motion < 8; ++motion) {
				const Pair    there = moved(pair, result.point, linear.across / 3, linear.radius, random);
				ContactResult followed;
				OutlineMotion outline;
				ASSERT_TRUE(linear.follow(there.placed(), settings, memory.point[0], memory.point[1], followed, outline));
				EXPECT_EQ(followed.normal[2], 0);
				EXPECT_NEAR(followed.turningArm, 0, 1e-12);
				const ContactLoad one(followed, model), other(query(there, settings), model);
				EXPECT_LE((one.force - other.force).norm(), tolerance::linearLeftOut * size);
				EXPECT_LE((one.moment - other.moment - result.point.cross(one.force - other.force)).norm(),
				        tolerance::linearLeftOut * size * linear.radius);
			}
		}
	EXPECT_GT(touching, 150);
	EXPECT_GT(known, touching * 3 / 4);
}

/// A pair that is apart, and a contact whose force is not linear over the differences.
TEST(LinearByDifferences, LeavesUnknownWhatIsNotSmooth)
{
	const Piece     piece;
	ContactSettings settings;
	settings.contactModel = ContactModel::Foundation;
	settings.internal     = &piece.covered;
	Pair pair;
	pair.shape[0] = piece.shape;
	pair.shape[1] = ConvexShape::shared(cuboid(Real(0.5), Real(0.4), Real(0.3)), 0);
	LinearContact    linear;
	ContactWorkspace workspace;
	for (const Real depth : { Real(-1e-3), Real(1e-3) }) {
		pair.centre2 = Vector3(Real(0.2), 0, Real(1.3) - depth);
		PairMemory          memory;
		const ContactResult result = query(pair, settings, &memory);
		linear.known               = true;
		linearByDifferences(pair.placed(), settings, memory, workspace, result, linear);
		EXPECT_EQ(linear.known, depth > 0);
	}
	// a corner, with differences as large as its depth: what they leave out shows
	pair.rotation[1] = Eigen::AngleAxis<Real>(Real(0.7), Vector3(1, 1, 0).normalized()).toRotationMatrix();
	PairMemory memory;
	pair.centre2               = Vector3(Real(0.2), 0, Real(1.3));
	const ContactResult result = query(pair, settings, &memory);
	ContactResult       wrong  = result;
	wrong.infeasibility        = 1000 * result.infeasibility;
	linearByDifferences(pair.placed(), settings, memory, workspace, wrong, linear);
	EXPECT_FALSE(linear.known);
}
