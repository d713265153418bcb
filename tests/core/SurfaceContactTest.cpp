// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SurfaceContact.hpp"
#include "ContactLoad.hpp"
#include "SurfaceOfPair.hpp"
#include "contact/PairOrder.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;
using namespace polytope::samples;

namespace {

ContactSettings with(ContactModel model, const ClosureLaw* closure = nullptr)
{
	ContactSettings settings;
	settings.contactModel = model;
	settings.closure      = closure;
	return settings;
}

using Load = ContactLoad;

constexpr ContactModel models[] = { ContactModel::Foundation, ContactModel::Spring };

template <int D> Pair somePair(int trial, std::mt19937_64& random, const Shapes& shapes)
{
	if (trial % 4) return randomPair(shapes, random);
	return D == 3 ? thinPair(trial / 4, random) : nearlyParallelPair(random, 2);
}

template <int D> void expectSumsOfTheSurface()
{
	std::mt19937_64 random(60 + D);
	const Shapes    shapes = randomShapes(40, random, D, -2);
	int             asked  = 0;
	for (int trial = 0; trial < 300; ++trial) {
		SCOPED_TRACE(trial);
		const Pair pair = somePair<D>(trial, random, shapes);
		const Real size = pair.size();
		if (!(infeasibility(pair) < -1e-11 * size)) continue;
		const SurfaceOfPair<D> own(pair);
		const Real             rounding = 256 * tolerance::rounding * pair.reach() / own.deepest;
		const Real             thick    = D == 2 ? std::min(pair.shape[0]->thickness(), pair.shape[1]->thickness()) : Real(1);
		const ContactResult    area = query(pair, with(ContactModel::Foundation)), spring = query(pair, with(ContactModel::Spring));
		const Load             foundation(area, ContactModel::Foundation), one(spring, ContactModel::Spring);
		EXPECT_TRUE(answered(area.status)) << statusName(area.status);
		const Real pressure = 2 * thick * own.sums.pressure;
		EXPECT_LE((foundation.force - 2 * thick * own.force()).norm(), rounding * pressure);
		EXPECT_LE((foundation.moment - 2 * thick * own.moment()).norm(), rounding * pressure * pair.reach());
		EXPECT_NEAR(foundation.energy / (2 * thick * own.sums.volume), 1, rounding);
		const Real mean    = own.sums.level / own.sums.volume;
		const Real weight  = 36 * mean / own.sums.volume;
		const Real allowed = rounding * weight * (own.deepest + mean) * own.sums.pressure;
		EXPECT_LE((one.force - weight * (own.deeper() - mean * own.force())).norm(), allowed);
		EXPECT_LE((one.moment - weight * (own.deeperTurn() - mean * own.moment())).norm(), allowed * pair.reach());
		EXPECT_NEAR(one.energy / (18 * mean * mean), 1, rounding);
		++asked;
	}
	EXPECT_GT(asked, 150);
}

TEST(SurfaceContact, HasTheForceMomentAndEnergyOfTheSurface)
{
	expectSumsOfTheSurface<3>();
	expectSumsOfTheSurface<2>();
}

/// Energy before and after a small motion of body 2 against the work of force and moment.
TEST(SurfaceContact, WorkOfTheForceIsWhatTheEnergyFallsBy)
{
	std::mt19937_64 random(77);
	const int       faces[] = { 4, 6, 8, 12, 20 };
	for (const ContactModel model : models)
		for (int trial = 0; trial < 100; ++trial) {
			SCOPED_TRACE(trial);
			const Pair    pair = regularPair(faces[trial % 5], faces[trial / 5 % 5], decades(random, -4, -1), random);
			const Real    step = Real(1e-4) * -infeasibility(pair);
			const Vector3 way = randomDirection(random), axis = randomDirection(random);
			const Load    here(query(pair, with(model)), model);
			Real          energy[2];
			for (int side = 0; side < 2; ++side) {
				const Real by     = side == 0 ? -step : step;
				const auto turn   = Eigen::AngleAxis<Real>(by / 2, axis).toRotationMatrix();
				Pair       there  = pair;
				there.centre2     = turn * pair.centre2 + by * way;
				there.rotation[1] = turn * pair.rotation[1];
				energy[side]      = Load(query(there, with(model)), model).energy;
			}
			const Real work = here.force.dot(way) + here.moment.dot(axis) / 2;
			EXPECT_NEAR((energy[0] - energy[1]) / (2 * step) / here.force.norm(), work / here.force.norm(), 1e-5);
		}
}

/// The test above for joints that stiffen as they close: nearly linear ones, some half closed, and some beyond the end of the curve, where it bends within a
/// hundredth of the depth.
TEST(SurfaceContact, WorkOfAClosingJointIsWhatTheEnergyFallsBy)
{
	std::mt19937_64 random(78);
	const int       faces[] = { 4, 6, 8, 12, 20 };
	for (const ContactModel model : models)
		for (int trial = 0; trial < 100; ++trial) {
			SCOPED_TRACE(trial);
			const Pair pair = trial % 7 ? regularPair(faces[trial % 5], faces[trial / 5 % 5], decades(random, -4, -1), random)
			                            : somePair<2>(trial, random, randomShapes(40, random, 2, -2));
			const Real deepest = -infeasibility(pair);
			if (!(deepest > 1e-4 * pair.size())) continue; // of thinner ones the differences are rounded
			const Real    most = deepest * decades(random, -1, 2), step = Real(1e-5) * deepest;
			const auto    law  = trial % 3 ? ClosureLaw::hyperbola(most) : ClosureLaw::power(0.4, most);
			const Vector3 way  = trial % 7 ? randomDirection(random) : Vector3(Vector3::UnitX()),
			              axis = trial % 7 ? randomDirection(random) : Vector3(Vector3::UnitZ());
			const Load here(query(pair, with(model, &law)), model, law);
			Real       energy[2];
			for (int side = 0; side < 2; ++side) {
				const Real by     = side == 0 ? -step : step;
				const auto turn   = Eigen::AngleAxis<Real>(by / 2, axis).toRotationMatrix();
				Pair       there  = pair;
				there.centre2     = turn * pair.centre2 + by * way;
				there.rotation[1] = turn * pair.rotation[1];
				energy[side]      = Load(query(there, with(model, &law)), model, law).energy;
			}
			const Real work = here.force.dot(way) + here.moment.dot(axis) / 2;
			EXPECT_NEAR((energy[0] - energy[1]) / (2 * step) / here.force.norm(), work / here.force.norm(), 1e-5);
		}
}

/// A face on a face closes by the overlap, with the energy of the closed form; so does what tilts little.
TEST(SurfaceContact, OfAClosingJointOnAFaceHasItsPressureAndEnergy)
{
	const Real       h   = 1e-4;
	const ClosureLaw law = ClosureLaw::hyperbola(2e-4);
	for (const bool flat : { false, true })
		for (const ContactModel model : models) {
			Pair pair;
			pair.shape[0]              = ConvexShape::shared(flat ? rectangle(4, 1) : cuboid(4, 1, 4), Real(0.1));
			pair.shape[1]              = ConvexShape::shared(flat ? rectangle(1, 1) : cuboid(1, 1, 1), Real(0.1));
			pair.centre2               = Vector3(Real(0.5), 2 - h, 0);
			const ContactResult result = query(pair, with(model, &law));
			EXPECT_NEAR(result.depth / h, 1, 4 * h);
			EXPECT_NEAR(result.energy * 4 / (4e-8 * (std::log(2.) - 0.5)), 1, 8 * h);
			EXPECT_NEAR(result.area, flat ? 2 : 4, 8 * h);
		}
}

/// A maximum closure far beyond the overlap leaves what there is without.
TEST(SurfaceContact, OfAJointThatHardlyClosesIsTheLinearOne)
{
	std::mt19937_64 random(79);
	const Shapes    shapes = randomShapes(40, random, 3, -2);
	for (const ContactModel model : models)
		for (int trial = 0; trial < 50; ++trial) {
			const Pair pair = somePair<3>(trial, random, shapes);
			if (!(infeasibility(pair) < -1e-9 * pair.size())) continue;
			const ClosureLaw law = ClosureLaw::hyperbola(Real(1e12) * pair.size());
			const Load       linear(query(pair, with(model)), model), joint(query(pair, with(model, &law)), model, law);
			EXPECT_LE((linear.force - joint.force).norm(), 1e-9 * linear.force.norm()) << trial;
			EXPECT_NEAR(joint.energy / linear.energy, 1, 1e-9) << trial;
		}
}

TEST(SurfaceContact, OfAFaceOnAFaceIsTheOverlap)
{
	for (const Real h : { 1e-2, 1e-4, 1e-7 })
		for (const bool flat : { false, true })
			for (const ContactModel model : models) {
				Pair pair;
				pair.shape[0]              = ConvexShape::shared(flat ? rectangle(4, 1) : cuboid(4, 1, 4), Real(0.1));
				pair.shape[1]              = ConvexShape::shared(flat ? rectangle(1, 1) : cuboid(1, 1, 1), Real(0.1));
				pair.centre2               = Vector3(Real(0.5), 2 - h, 0);
				const ContactResult result = query(pair, with(model));
				EXPECT_EQ(result.status, ContactStatus::Contact);
				EXPECT_LE((result.normal - Vector3::UnitY()).norm(), 1e-14);
				EXPECT_NEAR(result.depth / h, 1, 2 * h);
				EXPECT_NEAR(result.energy / (h * h / 2), 1, 2 * h);
				EXPECT_NEAR(result.area, flat ? 2 : 4, 8 * h);
				EXPECT_LE((result.point - Vector3(Real(0.5), 1 - h / 2, 0)).norm(), h);
				EXPECT_LE(std::abs(result.turningArm), 1e-15);
			}
}

/// A slab up to x = end, and the two that a vertical plane through the seam cuts it into, as body 1; the side of each that the other one covers.
template <int D> struct CutSlab {
	std::shared_ptr<const ConvexShape> whole, half[2];
	Vector3                            middle, centre[2];
	InternalPlanes                     covered[2];

	explicit CutSlab(Real seam, Real end = 4)
	{
		const Real begin = -4, high = 1;
		whole  = slab((end - begin) / 2, high);
		middle = Vector3((begin + end) / 2, 0, 0);
		for (int k = 0; k < 2; ++k) {
			const Real low = k == 0 ? begin : seam, top = k == 0 ? seam : end;
			half[k]   = slab((top - low) / 2, high);
			centre[k] = Vector3((top + low) / 2, 0, 0);
			const Vector3 out((k == 0 ? 1 : -1), 0, 0);
			for (int i = 0; i < half[k]->planeCount(); ++i)
				if (half[k]->planes().normals[std::size_t(i)].dot(out) > Real(0.9)) covered[k].add(0, i);
			covered[k].addEnd(0, { out, (end - begin) - (top - low) / 2 });
			covered[k].radius[0] = whole->boundingRadius() + centre[k].norm();
		}
	}
	static std::shared_ptr<const ConvexShape> slab(Real wide, Real high)
	{
		return ConvexShape::shared(D == 2 ? rectangle(wide, high) : cuboid(wide, high, 4), 0);
	}
};

/// A body that lies on the joint between two pieces of one solid has the solid's contact with both together: the same force, moment, area and energy.
template <int D> void expectPiecesToHaveTheContactOfTheSolid()
{
	std::mt19937_64 random(88 + D);
	const Shapes    shapes = randomShapes(21, random, D, 0);
	int             parted = 0;
	for (int trial = 0; trial < 200; ++trial) {
		SCOPED_TRACE(trial);
		if (trial % 3 == 2) continue; // flat ones, whose overlaps are so thin that rounding shows
		Pair pair;
		pair.shape[1]                             = shapes[std::size_t(trial) % shapes.size()];
		pair.rotation[1]                          = randomRotation(random, D);
		const Real                           down = pair.shape[1]->widthAlong(pair.rotation[1].transpose() * Vector3::UnitY()) / 2;
		std::uniform_real_distribution<Real> some(-1, 1);
		Real                                 lowest = 0;
		for (const Vector3& vertex : pair.shape[1]->polyhedron().vertices)
			lowest = std::min(lowest, Vector3(pair.rotation[1] * vertex)[1]);
		const Real overlap           = down * decades(random, -3, -2);
		pair.centre2                 = Vector3(some(random) / 4, 1 - lowest - overlap, D == 2 ? Real(0) : some(random) / 4);
		pair.shape[0]                = CutSlab<D>(0).whole;
		const ContactResult touching = query(pair, with(ContactModel::Foundation));
		if (!touching.inContact) continue;
		const Real       seam = touching.point[0] + overlap * some(random) / 2; // through the contact
		const CutSlab<D> slab(seam, trial % 2 ? Real(4) : seam + overlap / 3);  // the solid ends within it, or far away
		pair.shape[0] = slab.whole;
		pair.centre2 -= slab.middle;
		for (const ContactModel model : models) {
			const ContactResult all = query(pair, with(model));
			if (!all.inContact) continue;
			const Load whole(all, model);
			Real       share = 0, energy = 0, area = 0;
			Vector3    force = Vector3::Zero(), moment = Vector3::Zero();
			for (int k = 0; k < 2; ++k) {
				Pair piece     = pair;
				piece.shape[0] = slab.half[k];
				piece.centre2 += slab.middle - slab.centre[k];
				ContactSettings       settings = with(model);
				const InternalPlanes& covered  = slab.covered[k];
				settings.internal              = &covered;
				const ContactResult result     = query(piece, settings);
				// named in the other order
				InternalPlanes ofSecond = covered;
				exchangeBodies(ofSecond);
				settings.internal = &ofSecond;
				EXPECT_EQ(query(swapped(piece), settings).share, result.share);
				if (!result.inContact) continue;
				EXPECT_EQ(result.status, all.status);
				const Load on(result, model);
				const Real part = model == ContactModel::Spring ? result.share : Real(1);
				share += result.share;
				area += result.area;
				force += part * on.force;
				moment += part * (on.moment + Vector3(slab.centre[k] - slab.middle).cross(on.force));
				energy += part * on.energy;
				parted += result.share < Real(0.99) && result.share > Real(0.01);
			}
			EXPECT_NEAR(share, 1, 1e-9);
			EXPECT_NEAR(area / all.area, 1, 1e-9);
			EXPECT_LE((force - whole.force).norm(), 1e-9 * whole.force.norm());
			EXPECT_LE((moment - whole.moment).norm(), 1e-9 * whole.force.norm());
			EXPECT_NEAR(energy / whole.energy, 1, 1e-9);
		}
	}
	EXPECT_GT(parted, 20);
}

TEST(SurfaceContact, PiecesHaveTheContactOfTheSolid)
{
	expectPiecesToHaveTheContactOfTheSolid<3>();
	expectPiecesToHaveTheContactOfTheSolid<2>();
}

/// The same for pieces that others cover on two sides, or three: a slab in six pieces (2-D: three), whose seams pass through the contact.
template <int D> void expectManyPiecesToHaveTheContactOfTheSolid()
{
	std::mt19937_64                      random(98 + D);
	const Shapes                         shapes = randomShapes(21, random, D, 0);
	std::uniform_real_distribution<Real> some(0, 1);
	int                                  parted = 0;
	for (int trial = 0; trial < 60; ++trial) {
		SCOPED_TRACE(trial);
		if (trial % 3 == 2) continue; // flat ones, whose overlaps are so thin that rounding shows
		Pair pair;
		pair.shape[0]    = CutSlab<D>::slab(4, 1);
		pair.shape[1]    = shapes[std::size_t(trial) % shapes.size()];
		pair.rotation[1] = randomRotation(random, D);
		Real lowest      = 0;
		for (const Vector3& vertex : pair.shape[1]->polyhedron().vertices)
			lowest = std::min(lowest, Vector3(pair.rotation[1] * vertex)[1]);
		const Real overlap           = pair.shape[1]->inscribedRadius() * decades(random, -3, -2);
		pair.centre2                 = Vector3(some(random) / 4, 1 - lowest - overlap, 0);
		const ContactResult touching = query(pair, with(ContactModel::Foundation));
		if (!touching.inContact) continue;
		const Vector3 at = touching.point;
		const Real x[] = { -4, at[0] - overlap * some(random) / 3, at[0] + overlap * some(random) / 3, 4 }, z[] = { -4, at[2], 4 };
		const ContactLoad whole(touching, ContactModel::Foundation);
		Real              share = 0, energy = 0;
		Vector3           force = Vector3::Zero(), moment = Vector3::Zero();
		for (int column = 0; column < 3; ++column)
			for (int row = 0; row < D - 1; ++row) {
				const Real    low[] = { x[column], z[row] }, top[] = { x[column + 1], D == 2 ? Real(4) : z[row + 1] };
				const Real    wide = (top[0] - low[0]) / 2, deep = (top[1] - low[1]) / 2;
				const Vector3 centre((top[0] + low[0]) / 2, 0, (top[1] + low[1]) / 2);
				Pair          piece = pair;
				piece.shape[0]      = ConvexShape::shared(D == 2 ? rectangle(wide, 1) : cuboid(wide, 1, deep), 0);
				piece.centre2 -= centre;
				InternalPlanes covered;
				for (int i = 0; i < piece.shape[0]->planeCount(); ++i) {
					const Vector3& n = piece.shape[0]->planes().normals[std::size_t(i)];
					for (int k = 0; k < D - 1; ++k) {
						const Real beyond = n[2 * k] > Real(0.9) ? 4 - top[k]
						        : n[2 * k] < Real(-0.9)          ? low[k] + 4
						                                         : 0;
						if (!(beyond > 0)) continue;
						covered.add(0, i);
						covered.addEnd(0, { n, piece.shape[0]->planes().offsets[std::size_t(i)] + beyond });
					}
				}
				ContactSettings settings   = with(ContactModel::Foundation);
				settings.internal          = &covered;
				const ContactResult result = query(piece, settings);
				if (!result.inContact) continue;
				const Load on(result, ContactModel::Foundation);
				share += result.share;
				force += on.force;
				moment += on.moment + centre.cross(on.force);
				energy += on.energy;
				parted += covered.count[0] > 1 && result.share > Real(0.01);
			}
		EXPECT_NEAR(share, 1, 1e-9);
		EXPECT_LE((force - whole.force).norm(), 1e-9 * whole.force.norm());
		EXPECT_LE((moment - whole.moment).norm(), 1e-9 * whole.force.norm());
		EXPECT_NEAR(energy / whole.energy, 1, 1e-9);
	}
	EXPECT_GT(parted, 20);
}

TEST(SurfaceContact, PiecesCoveredOnSeveralSidesHaveTheContactOfTheSolid)
{
	expectManyPiecesToHaveTheContactOfTheSolid<3>();
	expectManyPiecesToHaveTheContactOfTheSolid<2>();
}

/// Two bodies that are both cut in two, one of which lies on the other with a face or an edge over the joints of both: the four pairs of pieces have
/// together the contact of the two solids.
template <int D> void expectPiecesOnPiecesToHaveTheContactOfTheSolids()
{
	std::mt19937_64                      random(188 + D);
	std::uniform_real_distribution<Real> some(-1, 1);
	int                                  parted = 0;
	for (int trial = 0; trial < 200; ++trial) {
		SCOPED_TRACE(trial);
		Pair pair;
		pair.shape[0] = pair.shape[1] = CutSlab<D>(0).whole;
		const Real tilt               = decades(random, -6, -3);
		const auto turned             = [](const Real& angle, const Vector3& axis) { return Eigen::AngleAxis<Real>(angle, axis); };
		const Real onEdge             = D == 3 && trial % 2 ? Real(0.8) : tilt;
		const auto lying              = turned(tilt, Vector3::UnitZ());
		pair.rotation[1]              = lying.toRotationMatrix();
		if (D == 3)
			pair.rotation[1]
			        *= (turned(3 * some(random), Vector3::UnitY()) * turned(onEdge, Vector3::UnitX())).toRotationMatrix();
		Real lowest = 0;
		for (const Vector3& vertex : pair.shape[1]->polyhedron().vertices)
			lowest = std::min(lowest, Vector3(pair.rotation[1] * vertex)[1]);
		const Real overlap           = decades(random, -3, -2);
		pair.centre2                 = Vector3(some(random), 1 - lowest - overlap, D == 2 ? Real(0) : some(random));
		const ContactResult touching = query(pair, with(ContactModel::Foundation));
		ASSERT_TRUE(touching.inContact);
		const Vector3    there = pair.rotation[1].transpose() * (touching.point - pair.centre2);
		const CutSlab<D> slab(touching.point[0] + overlap * some(random) / 2), bar(there[0] + overlap * some(random) / 2);
		for (const ContactModel model : models) {
			const ContactResult all = query(pair, with(model));
			const Load          whole(all, model);
			Real                share = 0, energy = 0, area = 0;
			Vector3             force = Vector3::Zero(), moment = Vector3::Zero();
			for (int k = 0; k < 4; ++k) {
				const int one = k / 2, other = k % 2;
				Pair      piece = pair;
				piece.shape[0]  = slab.half[one];
				piece.shape[1]  = bar.half[other];
				piece.centre2 += pair.rotation[1] * bar.centre[other] - slab.centre[one];
				InternalPlanes both = slab.covered[one], ofBar = bar.covered[other];
				exchangeBodies(ofBar);
				both.add(1, ofBar.plane[1][0]);
				both.addEnd(1, ofBar.end[1][0]);
				both.radius[1]             = ofBar.radius[1];
				ContactSettings settings   = with(model);
				settings.internal          = &both;
				const ContactResult result = query(piece, settings);
				if (!result.inContact) continue;
				EXPECT_EQ(result.status, all.status);
				const Load on(result, model);
				const Real part = model == ContactModel::Spring ? result.share : Real(1);
				share += result.share;
				area += result.area;
				force += part * on.force;
				moment += part * (on.moment + slab.centre[one].cross(on.force));
				energy += part * on.energy;
				parted += result.share < Real(0.9) && result.share > Real(0.01);
			}
			const Real rounding = 1e-9;
			EXPECT_NEAR(share, 1, rounding);
			EXPECT_NEAR(area / all.area, 1, rounding);
			EXPECT_LE((force - whole.force).norm(), rounding * whole.force.norm());
			EXPECT_LE((moment - whole.moment).norm(), 4 * rounding * whole.force.norm());
			EXPECT_NEAR(energy / whole.energy, 1, rounding);
		}
	}
	EXPECT_GT(parted, 400);
}

TEST(SurfaceContact, PiecesOnPiecesHaveTheContactOfTheSolids)
{
	expectPiecesOnPiecesToHaveTheContactOfTheSolids<3>();
	expectPiecesOnPiecesToHaveTheContactOfTheSolids<2>();
}

TEST(SurfaceContact, ExchangesWithTheBodiesToTheBit)
{
	std::mt19937_64 random(78);
	const Shapes    shapes = randomShapes(30, random);
	for (const ContactModel model : models)
		for (int trial = 0; trial < 100; ++trial) {
			const Pair          pair   = randomPair(shapes, random);
			const ContactResult result = query(pair, with(model)), other = query(swapped(pair), with(model));
			ASSERT_EQ(other.inContact, result.inContact);
			EXPECT_EQ(other.depth, result.depth);
			EXPECT_EQ(other.normal, -result.normal);
			EXPECT_EQ(other.energy, result.energy);
		}
}

void expectSame(const Pair& pair, const ContactResult& warm, const ContactResult& cold, ContactModel model, bool energy = true)
{
	ASSERT_EQ(warm.inContact, cold.inContact);
	if (!(cold.infeasibility < -1e-9 * pair.size())) return;
	const Real rounding = 1024 * tolerance::rounding * pair.reach() / -cold.infeasibility;
	const Real most     = std::max(cold.depth, -cold.infeasibility) * (model == ContactModel::Foundation ? cold.area : Real(1));
	const Load found(warm, model), other(cold, model);
	EXPECT_EQ(warm.status, cold.status);
	EXPECT_LE((found.force - other.force).norm(), rounding * most);
	EXPECT_LE((found.moment - other.moment).norm(), rounding * most * pair.reach());
	if (energy) {
		EXPECT_NEAR(warm.energy / cold.energy, 1, rounding);
	}
}

/// Walks of pairs that overlap by a hundredth or, not `deep`, by any part of their size. Returns which part of the contacts had the surface of the step before.
Real walk(ContactModel model, bool energy, Real stride, const Shapes& shapes, bool deep = true)
{
	ContactSettings settings = with(model);
	settings.energy          = energy;
	std::mt19937_64 random(79);
	int             contacts = 0, kept = 0;
	for (int trial = 0; trial < 60; ++trial) {
		Pair       pair = randomPair(shapes, random);
		PairMemory memory;
		if (deep) moveTo(pair, randomDirection(random), Real(-0.01) * pair.inscribedRadius());
		for (int step = 0; step < 10; ++step) {
			SCOPED_TRACE(std::to_string(trial) + " step " + std::to_string(step));
			pair.centre2 += stride * pair.inscribedRadius() * randomDirection(random);
			pair.rotation[1] = Eigen::AngleAxis<Real>(stride, randomDirection(random)).toRotationMatrix() * pair.rotation[1];
			const ContactResult warm = query(pair, settings, &memory);
			expectSame(pair, warm, query(pair, settings), model, energy);
			contacts += step > 0 && warm.inContact;
			kept += warm.surfaceKept;
		}
	}
	return Real(kept) / Real(contacts);
}

TEST(SurfaceContact, OnPiecesIsTheSameWarmAsCold)
{
	std::mt19937_64                      random(90);
	std::uniform_real_distribution<Real> some(-1, 1);
	const Shapes                         shapes = randomShapes(21, random, 3, 0);
	const CutSlab<3>                     slab(0);
	int                                  kept = 0, contacts = 0;
	for (int trial = 0; trial < 120; ++trial) {
		if (trial % 3 == 2) continue; // flat ones, whose overlaps are so thin that rounding shows
		const ContactModel model    = models[std::size_t(trial / 3) % std::size(models)];
		ContactSettings    settings = with(model);
		settings.internal           = &slab.covered[0];
		Pair piece;
		piece.shape[0]    = slab.half[0];
		piece.shape[1]    = shapes[std::size_t(trial) % shapes.size()];
		piece.rotation[1] = randomRotation(random, 3);
		Real lowest       = 0;
		for (const Vector3& vertex : piece.shape[1]->polyhedron().vertices)
			lowest = std::min(lowest, Vector3(piece.rotation[1] * vertex)[1]);
		const Real size = piece.shape[1]->inscribedRadius();
		piece.centre2   = Vector3(size * some(random), 1 - lowest - size / 50, size * some(random)) - slab.centre[0];
		PairMemory memory;
		for (int step = 0; step < 10; ++step) {
			SCOPED_TRACE(std::to_string(trial) + " step " + std::to_string(step));
			const Real stride = size / 10000;
			piece.centre2 += stride * randomDirection(random);
			piece.rotation[1] = Eigen::AngleAxis<Real>(1e-4, randomDirection(random)).toRotationMatrix() * piece.rotation[1];
			const ContactResult warm = query(piece, settings, &memory), cold = query(piece, settings);
			expectSame(piece, warm, cold, model);
			EXPECT_NEAR(warm.share, cold.share, 1e-9);
			contacts += step > 0 && warm.inContact;
			kept += warm.surfaceKept;
		}
	}
	EXPECT_GT(contacts, 300);
	EXPECT_GT(kept, contacts * 9 / 10);
}

// However deep: a body that is nearly through one of two pieces has on them what it has on both in one.
TEST(SurfaceContact, DeepInPiecesIsThatOfTheirSolid)
{
	const CutSlab<3> slab(0);
	for (const ContactModel model : models)
		for (const Real deep : { 0.02, 0.6, 0.9 }) {
			Vector3 force = Vector3::Zero(), whole = Vector3::Zero();
			Real    share = 0;
			for (int k = 0; k < 2; ++k) {
				ContactSettings settings = with(model);
				settings.section         = true;
				settings.internal        = &slab.covered[k];
				Pair pair;
				pair.shape[0]           = slab.half[k];
				pair.shape[1]           = ConvexShape::shared(cuboid(0.5, 0.5, 0.5), 0);
				pair.centre2            = Vector3(-0.2, 1.5 - deep, 0.1) - slab.centre[k];
				const ContactResult one = query(pair, settings);
				share += one.share;
				force += one.depth * (model == ContactModel::Foundation ? one.area : one.share) * one.normal;
				settings.internal = nullptr;
				pair.shape[0]     = slab.whole;
				pair.centre2      = Vector3(-0.2, 1.5 - deep, 0.1);
				const auto all    = query(pair, settings);
				whole             = all.depth * (model == ContactModel::Foundation ? all.area : Real(1)) * all.normal;
			}
			EXPECT_NEAR(share, 1, 1e-12);
			EXPECT_NEAR((force - whole).norm(), 0, 1e-12 * whole.norm());
		}
}

TEST(SurfaceContact, IsTheSameWarmAsCold)
{
	std::mt19937_64 random(79);
	const Shapes    some = randomShapes(30, random, 3, -1);
	Shapes          regular;
	for (const int faces : { 4, 6, 8, 12, 20 })
		regular.push_back(ConvexShape::shared(regularSolid(faces, 1), Real(0.1)));
	for (const ContactModel model : models)
		for (const bool energy : { false, true }) {
			EXPECT_GT(walk(model, energy, 1e-5, some), 0.95);
			EXPECT_GT(walk(model, energy, 1e-3, some), 0.4);
			EXPECT_GT(walk(model, energy, 1e-5, regular), 0.95);
			walk(model, energy, 1e-3, some, false);
			walk(model, energy, 1e-3, regular, false);
		}
}

/// A column at rest: sides in line, whose blocks go up and down.
TEST(SurfaceContact, OfCubesInLineIsKept)
{
	std::mt19937_64 random(81);
	for (const ContactModel model : models)
		for (const bool turn : { false, true }) {
			Pair pair;
			pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), 0);
			pair.centre2                  = Vector3(0, 0, 2 - 1e-3);
			if (turn) pair = turned(pair, randomRotation(random));
			const Vector3 up = pair.rotation[0].col(2);
			PairMemory    memory;
			for (int step = 0; step < 20; ++step) {
				SCOPED_TRACE(step);
				pair.centre2 += 1e-5 * std::sin(Real(step)) * up;
				const ContactResult warm = query(pair, with(model), &memory), cold = query(pair, with(model));
				expectSame(pair, warm, cold, model);
				EXPECT_TRUE(warm.surfaceKept || step == 0);
				// sides in line press to neither side
				EXPECT_NEAR(warm.normal.dot(up), 1, 1e-12);
			}
			// moved aside, it has the sides' own force again
			pair.centre2 += 1e-6 * pair.rotation[0].col(0);
			expectSame(pair, query(pair, with(model), &memory), query(pair, with(model)), model);
		}
}

/// Those of a file, which has none, and of a step that has begun to ask for the energy, or no longer does.
TEST(SurfaceContact, PiecesThatAreKeptAreThoseMadeAgain)
{
	std::mt19937_64 random(81);
	const Shapes    shapes = randomShapes(30, random, 3, -1);
	int             kept   = 0;
	for (int trial = 0; trial < 300; ++trial) {
		SCOPED_TRACE(trial);
		Pair            pair     = randomPair(shapes, random);
		ContactSettings settings = with(ContactModel::Foundation);
		settings.energy          = trial % 2 == 0;
		PairMemory memory;
		if (!query(pair, settings, &memory).inContact || memory.surface.bytesOfPieces == 0) continue; // large sets have none
		pair.centre2 += Vector3::Constant(1e-6 * pair.size());
		PairMemory          withPieces = memory, without = memory, other = memory;
		const ContactResult warm = query(pair, settings, &withPieces);
		if (!warm.surfaceKept) continue;
		++kept;
		without.surface.bytesOfPieces = 0;
		for (int step = 0; step < 2; ++step) {
			const ContactResult again = query(pair, settings, &without);
			EXPECT_TRUE(again.surfaceKept);
			EXPECT_EQ(again.point, warm.point);
			EXPECT_EQ(again.normal, warm.normal);
			EXPECT_EQ(again.depth, warm.depth);
			EXPECT_EQ(again.area, warm.area);
			EXPECT_EQ(again.energy, warm.energy);
			EXPECT_EQ(without.surface.bytesOfPieces, withPieces.surface.bytesOfPieces);
			without = memory;
		}
		for (int step = 0; step < 2; ++step) {
			settings.energy           = !settings.energy;
			const ContactResult again = query(pair, settings, &other);
			EXPECT_TRUE(again.surfaceKept);
			EXPECT_EQ(other.surface.ofEnergy, settings.energy);
			expectSame(pair, again, query(pair, settings), ContactModel::Foundation);
		}
	}
	EXPECT_GT(kept, 100);
}

TEST(SurfaceContact, AnyKeptSurfaceIsAGoodEnoughStart)
{
	std::mt19937_64 random(80);
	const Shapes    shapes = randomShapes(30, random, 3, -1);
	PairMemory      before;
	for (const ContactModel model : models)
		for (int trial = 0; trial < 400; ++trial) {
			SCOPED_TRACE(trial);
			Pair                pair = randomPair(shapes, random);
			PairMemory          memory;
			const ContactResult cold = query(pair, with(model));
			memory.surface           = before.surface; // of another pair
			if (trial % 2) {
				const bool likely       = trial % 4 == 1;
				memory.surface.planes   = std::uint8_t(random());
				memory.surface.vertices = std::uint8_t(random());
				for (auto& plane : memory.surface.plane)
					plane = std::uint16_t(likely ? random() % 40 : random());
				for (auto& vertex : memory.surface.tight)
					for (auto& plane : vertex)
						plane = std::uint8_t(likely ? random() % 16 : random());
				memory.surface.bytesOfPieces = 0; // they are not saved
			}
			memory.surface.exchanged = std::uint8_t(random() % 2);
			memory.surface.shared    = std::uint8_t(random() % 3);
			const ContactResult warm = query(pair, with(model), &memory);
			EXPECT_FALSE(warm.surfaceKept);
			expectSame(pair, warm, cold, model);
			before = memory;
		}
}

TEST(SurfaceContact, BodiesThatCoincideOrLieInOneAnotherAreInEquilibrium)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (const Real half : { 1., 0.25 })
		for (const ContactModel model : models) {
			pair.shape[1]              = ConvexShape::shared(cuboid(half, half, half), 0);
			const ContactResult result = query(pair, with(model));
			EXPECT_TRUE(result.inContact);
			EXPECT_EQ(result.status, ContactStatus::NoDirection);
			EXPECT_LE(result.depth, 1e-15);
			EXPECT_GT(result.area, 0);
			EXPECT_NEAR(result.normal.norm(), 1, 1e-15);
			// ∫ p over a cube of half width a is 2 a⁴, its mean s over the pyramid of height a in four dimensions a/5
			const Real energy = model == ContactModel::Foundation ? result.energy * result.area : result.energy;
			EXPECT_NEAR(energy / (model == ContactModel::Foundation ? 4 * std::pow(half, 4) : 18 * half * half / 25), 1, 1e-13);
		}
}

TEST(SurfaceContact, PosesThatAreNoneFail)
{
	for (const ContactModel model : models) {
		Pair pair;
		pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
		pair.centre2                  = Vector3(0, 0, NAN);
		EXPECT_EQ(query(pair, with(model)).status, ContactStatus::Failed);
		pair.centre2           = Vector3(0, 0, Real(1.5));
		pair.rotation[1](0, 0) = INFINITY;
		EXPECT_EQ(query(pair, with(model)).status, ContactStatus::Failed);
	}
}

} // namespace
