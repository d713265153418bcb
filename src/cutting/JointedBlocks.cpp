// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/JointedBlocks.hpp"

#include "cutting/RockBridges.hpp"
#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <utility>

namespace polytope {
namespace {

	/// Cuts a tree's blocks by one joint after the other.
	class Cuts {
	public:
		Cuts(JointedBlocks& rock, std::vector<Block> regions, const Cutting& how) : rock_(rock), how_(how), random_(how.seed)
		{
			tree_.regions = int(regions.size());
			tree_.blocks  = std::move(regions);
			for (const Block& region : tree_.blocks)
				for (const Vector3& corner : region.corners)
					extent_ = std::max(extent_, Real(corner.norm()));
			on_    = construction::flatness * extent_;
			least_ = std::max(how.smallest, on_);
			for (int region = 0; region < tree_.regions; ++region)
				tree_.nodes.push_back(leaf(region));
		}

		/// Cuts every block that the joint reaches into.
		void cut(const FiniteJoint& joint, int plane)
		{
			rock_.areas.push_back(0);
			rock_.sections.push_back(0);
			const auto size = tree_.nodes.size();
			startAtRoots();
			while (!waiting_.empty()) {
				const int n = waiting_.back();
				waiting_.pop_back();
				++rock_.boxes;
				const CutNode& node = tree_.nodes[std::size_t(n)];
				if (!mayReach(joint, node)) continue;
				if (tree_.isLeaf(n)) cutLeaf(n, joint, plane);
				else waiting_.insert(waiting_.end(), { node.below, node.below + 1 });
			}
			rock_.cutting.push_back(tree_.nodes.size() > size);
		}

		/// The blocks in the order of the trees; those of one body that cuts with nothing else between them have made are one again.
		void collect(const std::vector<FiniteJoint>& joints)
		{
			std::vector<int> body(tree_.nodes.size(), -1);
			if (how_.bridge >= 0) body = bodiesOfNodes(tree_, { rock_.planes, rock_.firstJoint, joints, extent_ }, how_.bridge);
			std::vector<int> number(tree_.nodes.size(), -1);
			int              bodies = 0;
			startAtRoots();
			while (!waiting_.empty()) {
				const int n = waiting_.back(), whole = body[std::size_t(n)];
				waiting_.pop_back();
				const CutNode& node = tree_.nodes[std::size_t(n)];
				if (whole < 0 && !tree_.isLeaf(n)) {
					waiting_.insert(waiting_.end(), { node.below + 1, node.below });
					continue;
				}
				rock_.blocks.push_back(std::move(tree_.blocks[std::size_t(node.block)]));
				int& known = number[std::size_t(whole < 0 ? n : whole)];
				if (known < 0) known = bodies++;
				rock_.bodies.push_back(known);
			}
		}

	private:
		JointedBlocks&   rock_;
		const Cutting&   how_;
		CutTree          tree_;
		std::vector<int> waiting_;
		Real             extent_ = 0, on_ = 0, least_ = 0;
		std::mt19937_64  random_;

		void startAtRoots()
		{
			waiting_.resize(std::size_t(tree_.regions));
			std::iota(waiting_.rbegin(), waiting_.rend(), 0);
		}

		CutNode leaf(int block) const
		{
			const std::vector<Vector3>& corners = tree_.blocks[std::size_t(block)].corners;
			Vector3                     low = corners.front(), high = corners.front();
			for (const Vector3& corner : corners) {
				low  = low.cwiseMin(corner);
				high = high.cwiseMax(corner);
			}
			return { (low + high) / 2, (high - low) / 2, block, -1 };
		}

		static bool mayReach(const FiniteJoint& joint, const CutNode& node)
		{
			const auto crosses = [&](const Plane& plane, bool wholly) {
				const Real height = plane.normal.dot(node.middle) - plane.offset;
				return (wholly ? height : Real(abs(height))) < plane.normal.cwiseAbs().dot(node.half);
			};
			if (!crosses(joint.plane, false)) return false;
			if (joint.radius > 0) {
				const Vector3 beyond = ((joint.centre - node.middle).cwiseAbs() - node.half).cwiseMax(Vector3::Zero());
				if (beyond.squaredNorm() >= joint.radius * joint.radius) return false;
			}
			for (const Plane& edge : joint.edges)
				if (!crosses(edge, true)) return false;
			return true;
		}

		bool crosses(const Plane& joint, const CutNode& node) const
		{
			const Real least = construction::touching * extent_;
			Real       low = 0, high = 0;
			for (const Vector3& corner : tree_.blocks[std::size_t(node.block)].corners) {
				const Real height = joint.normal.dot(corner) - joint.offset;
				low               = std::min(low, height);
				high              = std::max(high, height);
			}
			return low < -least && high > least;
		}

		void cutLeaf(int n, const FiniteJoint& joint, int plane)
		{
			const int block = tree_.nodes[std::size_t(n)].block;
			if (!crosses(joint.plane, tree_.nodes[std::size_t(n)])) return;
			Block      below, above;
			const bool both = cutBlock(tree_.blocks[std::size_t(block)], rock_.planes, plane, on_, below, above);
			if (!both) {
				++rock_.uncut;
				return;
			}
			const Polygon section = sectionOf(below, plane);
			const Real    whole   = areaOfPolygon(section, joint.plane.normal),
			           own        = joint.bounded() ? areaWithin(joint, section) : whole;
			if (own <= construction::touching * whole) return;
			if (joint.persistence < 1 && double(random_() >> 11) * 0x1p-53 >= joint.persistence) return;
			if (!below.holdsBall(rock_.planes, least_) || !above.holdsBall(rock_.planes, least_)) {
				++rock_.uncut;
				return;
			}
			rock_.areas.back() += own;
			rock_.sections.back() += whole;
			replace(n, std::move(below), std::move(above));
		}

		void replace(int n, Block&& below, Block&& above)
		{
			const int first = int(tree_.blocks.size());
			tree_.blocks.push_back(std::move(below));
			tree_.blocks.push_back(std::move(above));
			if ((tree_.blocks.size() + std::size_t(tree_.regions)) / 2 > how_.most)
				refuse("jointSets: they cut more than " + std::to_string(how_.most)
				        + " blocks; is a spacing or a radius in another unit?");
			CutNode& node = tree_.nodes[std::size_t(n)];
			if (how_.bridge < 0) tree_.blocks[std::size_t(node.block)] = Block(); // bodies never become whole again
			node.below = int(tree_.nodes.size());
			tree_.nodes.push_back(leaf(first));
			tree_.nodes.push_back(leaf(first + 1));
		}

		/// The face that the cut has made, counter-clockwise about its normal.
		static Polygon sectionOf(const Block& below, int plane)
		{
			Polygon           section;
			const std::size_t face
			        = std::size_t(std::find(below.planes.begin(), below.planes.end(), plane) - below.planes.begin());
			if (face == below.faces()) return section;
			for (int k = below.begin(face); k < below.end(face); ++k)
				section.push_back(below.corners[std::size_t(below.rings[std::size_t(k)])]);
			return section;
		}
	};

	/// The blocks that the regions are, and their planes at the front of the list.
	std::vector<Block> wholeRegions(const std::vector<HalfSpaces>& regions, std::vector<Plane>& planes)
	{
		std::vector<std::vector<int>> which;
		for (const HalfSpaces& region : regions) {
			const HalfSpaces unit = withoutDuplicates(normalised(region));
			which.emplace_back(unit.size());
			std::iota(which.back().begin(), which.back().end(), int(planes.size()));
			for (std::size_t i = 0; i < unit.size(); ++i)
				planes.push_back({ unit.normals[i], unit.offsets[i] });
		}
		std::vector<Block> blocks;
		for (const std::vector<int>& one : which)
			blocks.push_back(blockOf(planes, one));
		return blocks;
	}

} // namespace

JointedBlocks cutByJoints(const std::vector<HalfSpaces>& regions, const std::vector<FiniteJoint>& joints, const Cutting& how)
{
	JointedBlocks      rock;
	std::vector<Block> whole = wholeRegions(regions, rock.planes);
	rock.firstJoint          = rock.planes.size();
	for (const FiniteJoint& joint : joints) {
		rock.planes.push_back(joint.plane);
		rock.planes.push_back({ -joint.plane.normal, -joint.plane.offset });
	}
	Cuts cuts(rock, std::move(whole), how);
	for (std::size_t j = 0; j < joints.size(); ++j)
		cuts.cut(joints[j], int(rock.firstJoint + 2 * j));
	cuts.collect(joints);
	return rock;
}

} // namespace polytope
