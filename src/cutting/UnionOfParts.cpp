// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/UnionOfParts.hpp"

#include "cutting/Block.hpp"
#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"
#include "shape/SolidMoments.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace polytope {
namespace {

	/// A part, and where its planes stand in the list that all have in common.
	struct Cutter {
		Block block;
		int   firstPlane = 0; ///< each is followed by itself turned round
		int   planes     = 0;
	};

	class Union {
	public:
		Union(const std::vector<UnionPart>& parts, std::size_t most) : most_(most)
		{
			Real reach = 0;
			for (const UnionPart& part : parts) {
				add(part.shape);
				for (const Vector3& corner : cutters_.back().block.corners)
					reach = std::max(reach, corner.norm());
			}
			on_ = construction::flatness * reach;
			std::vector<int> before;
			for (std::size_t k = 0; k < parts.size(); ++k) {
				density_ = parts[k].density;
				addRest(cutters_[k].block, before);
				before.push_back(int(k));
			}
		}

		UnionProperties properties() const
		{
			UnionProperties all;
			all.volume           = volume_;
			all.mass             = mass_.zeroth;
			all.centre           = mass_.first / mass_.zeroth;
			const Matrix3 spread = mass_.second - mass_.zeroth * all.centre * all.centre.transpose();
			all.inertia          = spread.trace() * Matrix3::Identity() - spread;
			return all;
		}

	private:
		std::vector<Plane>  planes_;
		std::vector<Cutter> cutters_;
		std::size_t         most_, pieces_ = 0;
		Real                on_ = 0, density_ = 1, volume_ = 0;
		SolidMoments        mass_; ///< times the density, from the origin

		void add(const PlacedShape& part)
		{
			const Polyhedron&  faces = part.shape.polyhedron();
			Cutter             cutter;
			std::vector<Plane> own;
			addPlanesOf(part, own);
			cutter.firstPlane = int(planes_.size());
			for (const Vector3& vertex : faces.vertices)
				cutter.block.corners.push_back(part.rotation * vertex + part.centre);
			for (std::size_t f = 0; f < faces.faces.size(); ++f) {
				cutter.block.rings.insert(cutter.block.rings.end(), faces.faces[f].begin(), faces.faces[f].end());
				cutter.block.closeFace(int(planes_.size()));
				const Plane& plane = own[std::size_t(faces.planeOfFace[f])];
				planes_.push_back(plane);
				planes_.push_back({ -plane.normal, -plane.offset });
				++cutter.planes;
			}
			cutters_.push_back(std::move(cutter));
		}

		/// Where corners are from a plane: lowest and highest.
		std::pair<Real, Real> heights(const std::vector<Vector3>& corners, int plane) const
		{
			const Plane& at  = planes_[std::size_t(plane)];
			Real         low = at.normal.dot(corners.front()) - at.offset, high = low;
			for (const Vector3& corner : corners) {
				const Real height = at.normal.dot(corner) - at.offset;
				low               = std::min(low, height);
				high              = std::max(high, height);
			}
			return { low, high };
		}

		/// The planes of a cutter that pass through a block, those that reach farthest out first. False where one of its faces, or one
		/// of the block's, has them on either side.
		bool crossing(const Block& block, const Cutter& cutter, std::vector<int>& planes) const
		{
			std::vector<std::pair<Real, int>> through;
			for (int k = 0; k < cutter.planes; ++k) {
				const int plane        = cutter.firstPlane + 2 * k;
				const auto [low, high] = heights(block.corners, plane);
				if (low >= -on_) return false;
				if (high > on_) through.push_back({ high, plane });
			}
			for (int plane : block.planes)
				if (heights(cutter.block.corners, plane).first >= -on_) return false;
			std::sort(through.begin(), through.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
			planes.clear();
			for (const auto& one : through)
				planes.push_back(one.second);
			return true;
		}

		/// What none of these cutters fills of a block.
		void addRest(const Block& block, const std::vector<int>& cutters)
		{
			if (++pieces_ > most_)
				refuse("parts: their union has more than " + std::to_string(most_)
				        + " convex pieces; give fewer parts in one place, or parts of fewer faces");
			std::vector<int> reaching, planes, fewest;
			int              chosen = -1;
			for (int k : cutters) {
				if (!crossing(block, cutters_[std::size_t(k)], planes)) continue;
				if (planes.empty()) return; // all of it is inside
				reaching.push_back(k);
				if (chosen < 0 || planes.size() < fewest.size()) {
					chosen = k;
					fewest = planes;
				}
			}
			if (chosen < 0) return add(block);
			reaching.erase(std::find(reaching.begin(), reaching.end(), chosen));
			std::vector<Block> outside;
			if (!cutOff(block, fewest, outside)) return addRest(block, reaching); // they are apart after all
			for (const Block& piece : outside)
				addRest(piece, reaching);
		}

		/// The pieces of a block outside of planes, disjoint. False: nothing is left inside.
		bool cutOff(const Block& block, const std::vector<int>& planes, std::vector<Block>& outside) const
		{
			Block inner = block;
			for (int plane : planes) {
				const auto [low, high] = heights(inner.corners, plane);
				if (low >= -on_) return false;
				if (high <= on_) continue;
				Block below, above;
				if (!cutBlock(inner, planes_, plane, on_, below, above)) continue; // a sliver thinner than rounding
				outside.push_back(std::move(above));
				inner = std::move(below);
			}
			return true;
		}

		void add(const Block& block)
		{
			const Vector3 middle = block.middle();
			const auto    corner
			        = [&](int k) -> Vector3 { return block.corners[std::size_t(block.rings[std::size_t(k)])] - middle; };
			SolidMoments own; // about the middle
			for (std::size_t f = 0; f < block.faces(); ++f)
				for (int k = block.begin(f) + 2; k < block.end(f); ++k)
					own.addTetrahedron(corner(block.begin(f)), corner(k - 1), corner(k));
			const Matrix3 across = own.first * middle.transpose();
			volume_ += own.zeroth;
			mass_.add(density_ * own.zeroth, density_ * (own.first + own.zeroth * middle),
			        density_ * (own.second + across + across.transpose() + own.zeroth * middle * middle.transpose()));
		}
	};

} // namespace

UnionProperties unionOf(const std::vector<UnionPart>& parts, std::size_t most) { return Union(parts, most).properties(); }

} // namespace polytope
