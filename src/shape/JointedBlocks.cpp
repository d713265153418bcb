// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/JointedBlocks.hpp"

#include "shape/ConstructionTolerances.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

namespace polytope {
namespace {

	/// The cuts made so far, with the boxes of what they cut.
	class Cuts {
	public:
		Cuts(JointedBlocks& rock, Block region, const Real& smallest) : rock_(rock), blocks_ { std::move(region) }
		{
			Real radius = 0;
			for (const Vector3& corner : blocks_[0].corners)
				radius = std::max(radius, corner.norm());
			on_    = construction::flatness * radius;
			least_ = std::max(smallest, on_);
			nodes_.push_back(leaf(0));
		}

		/// Cuts every block that the plane passes through. Whether there was any.
		bool cut(int plane)
		{
			const Plane joint = rock_.planes[std::size_t(plane)];
			const auto  size  = nodes_.size();
			waiting_.assign(1, 0);
			while (!waiting_.empty()) {
				const int n = waiting_.back();
				waiting_.pop_back();
				++rock_.boxes;
				const Node& node = nodes_[std::size_t(n)];
				if (abs(joint.normal.dot(node.middle) - joint.offset) >= joint.normal.cwiseAbs().dot(node.half)) continue;
				if (node.block >= 0) cutLeaf(n, plane);
				else waiting_.insert(waiting_.end(), { node.below, node.below + 1 });
			}
			return nodes_.size() > size;
		}

		/// The blocks in the order of the tree.
		void collect()
		{
			rock_.blocks.reserve(blocks_.size());
			waiting_.assign(1, 0);
			while (!waiting_.empty()) {
				const Node& node = nodes_[std::size_t(waiting_.back())];
				waiting_.pop_back();
				if (node.block >= 0) rock_.blocks.push_back(std::move(blocks_[std::size_t(node.block)]));
				else waiting_.insert(waiting_.end(), { node.below + 1, node.below });
			}
		}

	private:
		struct Node {
			Vector3 middle, half; ///< of the box
			int     block = -1;   ///< a leaf's
			int     below = -1;   ///< the part below the cut; the one above follows it
		};

		JointedBlocks&     rock_;
		std::vector<Block> blocks_;
		std::vector<Node>  nodes_;
		std::vector<int>   waiting_;
		Real               on_, least_;

		Node leaf(int block) const
		{
			const std::vector<Vector3>& corners = blocks_[std::size_t(block)].corners;
			Vector3                     low = corners.front(), high = corners.front();
			for (const Vector3& corner : corners) {
				low  = low.cwiseMin(corner);
				high = high.cwiseMax(corner);
			}
			return { (low + high) / 2, (high - low) / 2, block, -1 };
		}

		bool crosses(const Plane& joint, const Node& node) const
		{
			const Real least = std::max(Real(construction::touching * 2 * node.half.maxCoeff()), on_);
			Real       low = 0, high = 0;
			for (const Vector3& corner : blocks_[std::size_t(node.block)].corners) {
				const Real height = joint.normal.dot(corner) - joint.offset;
				low               = std::min(low, height);
				high              = std::max(high, height);
			}
			return low < -least && high > least;
		}

		void cutLeaf(int n, int plane)
		{
			const int block = nodes_[std::size_t(n)].block;
			if (!crosses(rock_.planes[std::size_t(plane)], nodes_[std::size_t(n)])) return;
			Block below, above;
			if (!parts(blocks_[std::size_t(block)], plane, below, above) || !below.holdsBall(rock_.planes, least_)
			        || !above.holdsBall(rock_.planes, least_)) {
				++rock_.uncut;
				return;
			}
			blocks_[std::size_t(block)] = std::move(below);
			blocks_.push_back(std::move(above));
			nodes_[std::size_t(n)].block = -1;
			nodes_[std::size_t(n)].below = int(nodes_.size());
			nodes_.push_back(leaf(block));
			nodes_.push_back(leaf(int(blocks_.size()) - 1));
		}

		/// False: a part is too flat to have an inside.
		bool parts(const Block& block, int plane, Block& below, Block& above) const
		{
			if (cutBlock(block, rock_.planes, plane, on_, below, above)) return true;
			try {
				for (int side = 0; side < 2; ++side) {
					std::vector<int> which = block.planes;
					which.push_back(plane + side);
					(side == 0 ? below : above) = blockOf(rock_.planes, which);
				}
				return true;
			} catch (const std::invalid_argument&) {
				return false;
			}
		}
	};

} // namespace

JointedBlocks cutByJoints(const HalfSpaces& region, const std::vector<Plane>& joints, const Real& smallest)
{
	const HalfSpaces unit = withoutDuplicates(normalised(region));
	JointedBlocks    rock;
	for (std::size_t i = 0; i < unit.size(); ++i)
		rock.planes.push_back({ unit.normals[i], unit.offsets[i] });
	std::vector<int> all(unit.size());
	std::iota(all.begin(), all.end(), 0);
	for (const Plane& joint : joints) {
		rock.planes.push_back(joint);
		rock.planes.push_back({ -joint.normal, -joint.offset });
	}
	Cuts cuts(rock, blockOf(rock.planes, all), smallest);
	for (std::size_t j = 0; j < joints.size(); ++j)
		rock.cutting.push_back(cuts.cut(int(unit.size() + 2 * j)));
	cuts.collect();
	return rock;
}

} // namespace polytope
