// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/JointedBlocks.hpp"

#include "ShapeSamples.hpp"
#include "shape/ConvexShape.hpp"

using namespace polytope;
using namespace polytope::samples;

namespace {

FiniteJoint throughout(const Plane& plane) { return { plane, Vector3::Zero(), 0, {} }; }

/// Sets of joints across the cube |x_k| ≤ length: `each` nearly normal to each axis.
std::vector<FiniteJoint> threeSets(int each, Real scatter, Real length, std::mt19937_64& random)
{
	std::vector<FiniteJoint> joints;
	for (int k = 0; k < 3; ++k)
		for (int i = 1; i <= each; ++i) {
			const Vector3 normal = (Vector3::Unit(k) + scatter * someDirection(random)).normalized();
			joints.push_back(throughout({ normal, (2 * Real(i) / (each + 1) - 1) * length * normal[k] }));
		}
	return joints;
}

HalfSpaces planesOf(const JointedBlocks& rock, const Block& block)
{
	HalfSpaces set;
	for (int plane : block.planes)
		add(set, rock.planes[std::size_t(plane)].normal, rock.planes[std::size_t(plane)].offset);
	return set;
}

Real volumeOf(const JointedBlocks& rock)
{
	Real sum = 0;
	for (const Block& block : rock.blocks)
		sum += block.volume();
	return sum;
}

/// Corners and faces are those that exact construction finds from the block's planes.
void expectAsConstructed(const JointedBlocks& rock, const Block& block, Real length)
{
	const HalfSpaces set   = planesOf(rock, block);
	const Polyhedron shape = polyhedron(set);
	ASSERT_EQ(shape.faces.size(), block.faces()) << "a plane without a face";
	EXPECT_EQ(shape.vertices.size(), block.corners.size());
	EXPECT_NEAR(block.volume(), massProperties(shape).volume, 1e-14 * length * length * length);
	for (const Vector3& corner : block.corners) {
		Real nearest = length;
		for (const Vector3& vertex : shape.vertices)
			nearest = std::min(nearest, (vertex - corner).norm());
		EXPECT_LE(nearest, 1e-11 * length);
	}
}

// The mean of a corner's four vertices is 0.144 from its oblique face; the largest ball has 1/(3 + √3) = 0.211.
TEST(Block, HoldsABallThatIsNotInItsMiddle)
{
	std::vector<Plane> planes { { Vector3::Ones().normalized(), 1 / std::sqrt(Real(3)) } };
	for (int k = 0; k < 3; ++k)
		planes.push_back({ -Vector3::Unit(k), 0 });
	const Block block = blockOf(planes, { 0, 1, 2, 3 });
	for (Real radius : { 0.1, 0.144, 0.15, 0.211 })
		EXPECT_TRUE(block.holdsBall(planes, radius)) << radius;
	for (Real radius : { 0.212, 0.3 })
		EXPECT_FALSE(block.holdsBall(planes, radius)) << radius;
}

TEST(JointedBlocks, fillTheRegionOnceAtEverySize)
{
	std::mt19937_64 random(71);
	for (Real length : lengths) {
		const auto rock = cutByJoints({ box(length, length, length) }, threeSets(6, Real(0.3), length, random), {});
		EXPECT_GT(rock.blocks.size(), 200u);
		EXPECT_NEAR(volumeOf(rock) / (8 * length * length * length), 1, 1e-13);
		for (const Block& block : rock.blocks)
			expectAsConstructed(rock, block, length);
		std::uniform_real_distribution<double> along(-1, 1);
		for (int i = 0; i < 200; ++i) {
			const Vector3 p     = length * Vector3(along(random), along(random), along(random));
			int           found = 0;
			for (const Block& block : rock.blocks) {
				bool inside = true;
				for (int plane : block.planes)
					inside = inside
					        && rock.planes[std::size_t(plane)].normal.dot(p) < rock.planes[std::size_t(plane)].offset;
				found += inside;
			}
			EXPECT_EQ(found, 1);
		}
	}
}

/// Joints through corners and edges that others have made, straight and turned: corners on the plane to rounding.
TEST(JointedBlocks, jointsThroughEdgesAndCorners)
{
	std::mt19937_64 random(72);
	for (Real length : lengths)
		for (int turn = 0; turn < 10; ++turn) {
			const Matrix3 rotation = turn == 0 ? Matrix3(Matrix3::Identity()) : someRotation(random);
			auto          joints   = threeSets(3, 0, length, random);
			for (int sign : { -1, 1 })
				for (int i = -2; i <= 2; ++i) {
					joints.push_back(throughout(
					        { Vector3(1, sign, 0).normalized(), Real(i) / 2 * length / std::sqrt(Real(2)) }));
					joints.push_back(throughout(
					        { Vector3(1, 1, sign).normalized(), Real(i) / 2 * length / std::sqrt(Real(3)) }));
				}
			for (FiniteJoint& joint : joints)
				joint.plane.normal = rotation * joint.plane.normal;
			const auto rock     = cutByJoints({ moved(box(length, length, length), rotation, Vector3::Zero()) }, joints, {});
			const auto straight = cutByJoints({ box(length, length, length) }, joints, {});
			EXPECT_GT(rock.blocks.size(), 300u);
			EXPECT_EQ(rock.uncut, 0u);
			EXPECT_NEAR(volumeOf(rock) / (8 * length * length * length), 1, 1e-12);
			EXPECT_NEAR(volumeOf(straight) / (8 * length * length * length), 1, 1e-12);
			for (const Block& block : rock.blocks) {
				EXPECT_GT(block.volume(), Real(1e-3) * length * length * length) << "a sliver that is rounding";
				expectAsConstructed(rock, block, length);
			}
		}
}

TEST(JointedBlocks, noPieceHoldsLessThanAsked)
{
	std::mt19937_64 random(73);
	const auto      joints = threeSets(12, Real(0.5), 1, random);
	const auto      fine = cutByJoints({ box(1, 1, 1) }, joints, {}), coarse = cutByJoints({ box(1, 1, 1) }, joints, { Real(0.02) });
	EXPECT_GT(fine.blocks.size(), coarse.blocks.size());
	EXPECT_GT(coarse.uncut, 0u);
	EXPECT_NEAR(volumeOf(coarse), 8, 1e-12);
	int small = 0;
	for (const Block& block : fine.blocks)
		small += !block.holdsBall(fine.planes, Real(0.02));
	EXPECT_GT(small, 10);
	for (const Block& block : coarse.blocks) {
		const MassProperties mass  = massProperties(polyhedron(planesOf(coarse, block)));
		const HalfSpaces     about = moved(planesOf(coarse, block), Matrix3::Identity(), -mass.centroid);
		EXPECT_GE(ConvexShape(about, 0).inscribedRadius(), Real(0.02) * (1 - 1e-12));
	}
}

/// A cut visits the boxes that it crosses: their number grows as the blocks do, not as blocks times joints.
TEST(JointedBlocks, theWorkGrowsAsTheBlocks)
{
	std::mt19937_64 random(74);
	Real            each[2];
	std::size_t     blocks[2];
	for (int k = 0; k < 2; ++k) {
		const auto joints = threeSets(k == 0 ? 8 : 30, Real(0.1), 1, random);
		const auto rock   = cutByJoints({ box(1, 1, 1) }, joints, { Real(1e-4) });
		blocks[k]         = rock.blocks.size();
		each[k]           = Real(rock.boxes) / Real(blocks[k]);
		EXPECT_LT(each[k], 40);
	}
	EXPECT_GT(blocks[1], 30 * blocks[0]);
	EXPECT_LT(each[1], 4 * each[0]);
}

TEST(JointedBlocks, refusesARegionThatIsNone)
{
	HalfSpaces open = box(1, 1, 1);
	open.normals.pop_back();
	open.offsets.pop_back();
	EXPECT_TRUE(says(refusal([&] { cutByJoints({ open }, {}, {}); }), "normals: the set is unbounded"));
	EXPECT_EQ(cutByJoints({ box(1, 1, 1) }, {}, {}).blocks.size(), 1u);
}

} // namespace
