// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/RockBridges.hpp"

#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"

#include <algorithm>
#include <numeric>

namespace polytope {
namespace {

	/// Numbers in groups.
	class Groups {
	public:
		explicit Groups(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

		int of(int i)
		{
			while (parent_[std::size_t(i)] != i)
				i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
			return i;
		}

		void join(int i, int j) { parent_[std::size_t(std::max(of(i), of(j)))] = std::min(of(i), of(j)); }

	private:
		std::vector<int> parent_;
	};

	/// Pairs of planes of the list that are near each other, whatever way they face: near(i, j) for normals (and offsets, × extent) that differ by less.
	template <class Near> void forNearPlanes(const JointedPlanes& rock, const Real& apart, const Near& near)
	{
		std::vector<int> order(rock.planes.size());
		std::iota(order.begin(), order.end(), 0);
		const auto distance = [&](int i) { return magnitude(rock.planes[std::size_t(i)].offset); };
		std::sort(order.begin(), order.end(), [&](int i, int j) { return distance(i) < distance(j); });
		for (std::size_t k = 0; k < order.size(); ++k)
			for (std::size_t m = k + 1; m < order.size() && distance(order[m]) - distance(order[k]) <= apart * rock.extent;
			        ++m) {
				const Plane &p = rock.planes[std::size_t(order[k])], &q = rock.planes[std::size_t(order[m])];
				const Real   sign = p.normal.dot(q.normal) < 0 ? -1 : 1;
				if ((p.normal - sign * q.normal).norm() <= apart
				        && magnitude(p.offset - sign * q.offset) <= apart * rock.extent)
					near(order[k], order[m]);
			}
	}

	/// Planes of the list that lie in one place: plane → the first of them.
	std::vector<int> placesOf(const JointedPlanes& rock)
	{
		Groups places(rock.planes.size());
		forNearPlanes(rock, construction::touching, [&](int i, int j) { places.join(i, j); });
		std::vector<int> place(rock.planes.size());
		for (std::size_t i = 0; i < place.size(); ++i)
			place[i] = places.of(int(i));
		return place;
	}

	/// A face in one place.
	struct RockFace {
		int     node;
		Polygon polygon; ///< counter-clockwise about the normal of the place
		Real    area;
		Vector3 low, high; ///< of its box
	};

	struct Place {
		std::vector<RockFace>           faces[2];          ///< of blocks below and above it
		std::vector<const FiniteJoint*> joints;            ///< here and near
		bool                            separates = false; ///< a joint without bounds
	};

	RockFace faceOf(const Block& block, std::size_t face, int node, const Vector3& normal, bool turned)
	{
		RockFace made { node, {}, 0, {}, {} };
		for (int k = block.begin(face); k < block.end(face); ++k)
			made.polygon.push_back(block.corners[std::size_t(block.rings[std::size_t(k)])]);
		if (turned) std::reverse(made.polygon.begin(), made.polygon.end());
		made.area = areaOfPolygon(made.polygon, normal);
		made.low = made.high = made.polygon.front();
		for (const Vector3& corner : made.polygon) {
			made.low  = made.low.cwiseMin(corner);
			made.high = made.high.cwiseMax(corner);
		}
		return made;
	}

	/// The places that have bounded joints, or none, with the faces there.
	std::vector<Place> facesByPlace(const CutTree& tree, const JointedPlanes& rock)
	{
		const std::vector<int> place = placesOf(rock);
		std::vector<Place>     places(rock.planes.size());
		for (std::size_t j = 0; j < rock.joints.size(); ++j) {
			Place& at = places[std::size_t(place[rock.firstJoint + 2 * j])];
			at.joints.push_back(&rock.joints[j]);
			at.separates = at.separates || !rock.joints[j].bounded();
		}
		const auto add = [&](int to, int plane) {
			const std::size_t joint = (std::size_t(plane) - rock.firstJoint) / 2, at = std::size_t(place[std::size_t(to)]);
			if (std::size_t(plane) < rock.firstJoint || place[std::size_t(plane)] == int(at)) return;
			auto& known = places[at].joints;
			if (std::find(known.begin(), known.end(), &rock.joints[joint]) == known.end()) known.push_back(&rock.joints[joint]);
		};
		forNearPlanes(rock, construction::nearPlane, [&](int i, int j) {
			add(i, j);
			add(j, i);
		});
		for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
			if (!tree.isLeaf(int(n))) continue;
			const Block& block = tree.blockOfNode(int(n));
			for (std::size_t f = 0; f < block.faces(); ++f) {
				const std::size_t plane = std::size_t(block.planes[f]), at = std::size_t(place[plane]);
				if (places[at].separates) continue;
				const Vector3& normal = rock.planes[at].normal;
				const bool     turned = normal.dot(rock.planes[plane].normal) < 0;
				places[at].faces[turned].push_back(faceOf(block, f, int(n), normal, turned));
			}
		}
		return places;
	}

	/// Whether joints leave more of what two faces share than a bridge of the smaller one: those that pass along it as near as they may without cutting.
	bool rockGoesOn(const Polygon& common, const Vector3& normal, const Place& place, const Real& on, const Real& least)
	{
		std::vector<const FiniteJoint*> along;
		for (const FiniteJoint* joint : place.joints)
			if (std::all_of(common.begin(), common.end(), [&](const Vector3& corner) {
				    return magnitude(joint->plane.normal.dot(corner) - joint->plane.offset) <= on;
			    }))
				along.push_back(joint);
		return uncovered(common, normal, along) > least;
	}

	/// Joins leaves across one place. Faces are swept along the direction in which they reach farthest.
	void joinAcross(Place& place, const Vector3& normal, const Real& on, const Real& bridge, Groups& leaves)
	{
		Vector3 low = Vector3::Constant(std::numeric_limits<double>::max()), high = -low;
		for (const auto& side : place.faces)
			for (const RockFace& face : side) {
				low  = low.cwiseMin(face.low);
				high = high.cwiseMax(face.high);
			}
		int along = 0;
		(high - low).maxCoeff(&along);
		const auto before = [&](const RockFace& a, const RockFace& b) { return a.low[along] < b.low[along]; };
		for (auto& side : place.faces)
			std::sort(side.begin(), side.end(), before);
		std::vector<const RockFace*> open[2]; // faces that the sweep is in
		std::size_t                  next[2] = { 0, 0 };
		const auto                   rest    = [&](int side) { return next[side] < place.faces[side].size(); };
		while (rest(0) || rest(1)) {
			const int       side   = !rest(1) || (rest(0) && before(place.faces[0][next[0]], place.faces[1][next[1]])) ? 0 : 1;
			const RockFace& face   = place.faces[side][next[side]++];
			auto&           others = open[1 - side];
			others.erase(std::remove_if(others.begin(), others.end(),
			                     [&](const RockFace* other) { return other->high[along] <= face.low[along]; }),
			        others.end());
			for (const RockFace* other : others) {
				if ((other->low - face.high).maxCoeff() > on || (face.low - other->high).maxCoeff() > on) continue;
				if (leaves.of(face.node) == leaves.of(other->node)) continue;
				const Polygon common = commonPart(face.polygon, other->polygon, normal);
				if (rockGoesOn(common, normal, place, on, bridge * std::min(face.area, other->area)))
					leaves.join(face.node, other->node);
			}
			open[side].push_back(&face);
		}
	}

} // namespace

std::vector<int> bodiesOfNodes(const CutTree& tree, const JointedPlanes& rock, const Real& bridge)
{
	Groups             leaves(tree.nodes.size());
	std::vector<Place> places = facesByPlace(tree, rock);
	for (std::size_t p = 0; p < places.size(); ++p)
		if (!places[p].faces[0].empty() && !places[p].faces[1].empty())
			joinAcross(places[p], rock.planes[p].normal, construction::touching * rock.extent, bridge, leaves);
	std::vector<int> body(tree.nodes.size());
	for (std::size_t n = tree.nodes.size(); n-- > 0;)
		if (tree.isLeaf(int(n))) body[n] = leaves.of(int(n));
		else {
			const std::size_t below = std::size_t(tree.nodes[n].below);
			body[n]                 = body[below] == body[below + 1] ? body[below] : -1;
		}
	return body;
}

} // namespace polytope
