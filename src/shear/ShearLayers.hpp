// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"
#include "shear/ShearTolerances.hpp"

/// The memory of a bed of shear springs whose area grows and shrinks.
///
/// Springs that join a growing area are unstrained: the force is unchanged. Springs that leave a shrinking one take their force with them
/// (Elata & Berryman 1996, Mechanics of Materials 24:229-240, for contacts of spheres). Which leave is what decides whether a load cycle
/// lets a body creep: those that came last are at the rim and leave first, almost unstrained, while the core keeps its force. A bed that
/// has one displacement for all of its springs loses force in each cycle, and the body creeps for ever.
///
/// For this reason the bed is a stack of layers, each of the springs that came at about the same time, with the core first, and knows where the middle of
/// each layer is: of those near to where area is lost the last leaves, for rims may lift in turn. Motion and turning strain all layers alike. Where there is
/// no room for one more layer, the two neighbours that differ least become one with their mean displacement, which loses ½ k a₁a₂/(a₁ + a₂) |e₁ − e₂|² of
/// energy. No change of area ever adds energy.
namespace polytope {

class ShearLayers {
public:
	/// One layer over the whole area, with one displacement.
	ShearLayers(Real area, const Vector3& displacement) : count_(1) { layer_[0] = { area, displacement }; }
	/// No springs.
	ShearLayers() = default;

	int  count() const { return count_; }
	Real area() const
	{
		Real sum = 0;
		for (int k = 0; k < count_; ++k)
			sum += layer_[k].area;
		return sum;
	}
	/// Area × mean displacement.
	Vector3 sum() const
	{
		Vector3 sum = Vector3::Zero();
		for (int k = 0; k < count_; ++k)
			sum += layer_[k].area * layer_[k].displacement;
		return sum;
	}
	/// Σ ½ a |e|²: energy over stiffness per area.
	Real energy() const
	{
		Real sum = 0;
		for (int k = 0; k < count_; ++k)
			sum += layer_[k].area * layer_[k].displacement.squaredNorm() / 2;
		return sum;
	}
	/// Σ a r × e, about the bed's centroid.
	Vector3 moment() const
	{
		Vector3 sum = Vector3::Zero();
		for (int k = 0; k < count_; ++k)
			sum += layer_[k].area * layer_[k].place.cross(layer_[k].displacement);
		return sum;
	}
	/// Σ a |r|²: what the bed's polar second moment is larger by than those of its layers [m⁴].
	Real spread() const
	{
		Real sum = 0;
		for (int k = 0; k < count_; ++k)
			sum += layer_[k].area * layer_[k].place.squaredNorm();
		return sum;
	}
	/// Moves all by the same.
	void move(const Vector3& by)
	{
		for (int k = 0; k < count_; ++k)
			layer_[k].displacement += by;
	}
	/// Turns the bed about its centroid by this small rotation.
	void strain(const Vector3& rotation)
	{
		for (int k = 0; k < count_; ++k)
			layer_[k].displacement += rotation.cross(layer_[k].place);
	}
	/// Applies a rotation, or what else is linear, to the displacements alone.
	template <class Map> void mapDisplacements(const Map& map)
	{
		for (int k = 0; k < count_; ++k)
			map(layer_[k].displacement);
	}
	/// Turns the bed in space, with all that it knows.
	template <class Map> void turn(const Map& map)
	{
		mapDisplacements(map);
		for (int k = 0; k < count_; ++k)
			map(layer_[k].place);
	}
	/// How the bed's area changes.
	struct Change {
		Vector3 ofCentroid = Vector3::Zero(); ///< way of its centroid through the bodies by that [m]
		Vector3 rotation   = Vector3::Zero(); ///< by which its springs are strained about their layers' middles
		Real    reach      = 0;               ///< of the bed from its centroid [m]; 0: it is not known where area joins or leaves
	};
	/// Springs join or leave until the area is this [m²].
	void setArea(Real present, const Change& change);
	void setArea(Real present) { setArea(present, Change()); }
	/// Layers are not farther apart than a bed of this polar second moment [m⁴] can have them.
	void limitSpread(Real second);

private:
	struct Layer {
		Real    area         = 0;
		Vector3 displacement = Vector3::Zero();
		Vector3 place        = Vector3::Zero(); ///< of its middle, from the bed's centroid
	};

	void join(Real more, const Vector3& place);
	void leave(Real less, Vector3 place, const Change& change);
	int  leavingAt(const Vector3& place, Real reach) const;
	void remove(int k);
	void mergeLeastDifferent();

	Layer layer_[tolerance::shearLayers];
	int   count_   = 0;
	bool  growing_ = false; ///< the last layer takes what comes next

	template <class Visit> friend void visitParts(ShearLayers& layers, const Visit& visit);
};

/// Calls visit(name, value) for all that a saved state needs: `count`, `growing`, then area, displacement and place of each layer.
template <class Visit> void visitParts(ShearLayers& layers, const Visit& visit)
{
	visit("count", layers.count_);
	visit("growing", layers.growing_);
	for (int k = 0; k < layers.count_ && k < tolerance::shearLayers; ++k) {
		visit("area", layers.layer_[k].area);
		visit("displacement", layers.layer_[k].displacement);
		visit("place", layers.layer_[k].place);
	}
}

} // namespace polytope
