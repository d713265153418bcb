// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>
#include <src/shape/ConvexShape.hpp>

#include "contact/PieceTolerances.hpp"
#include "shape/FacetShape.hpp"
#include "shape/ShapeFamily.hpp"

#include <array>
#include <vector>

/// The half-spaces that stand for a facet: the ground behind it.
///
/// A facet alone is the front of a prism with upright sides. Prisms of a mesh that is bent would overlap behind a convex edge, so that what
/// presses on the edge would be counted twice, and leave a wedge free behind a hollow one. So the side at an edge that another facet shares
/// is mitred: it is the plane half-way between both. At a convex tip the prism holds what is nearer to its facet than to the others there.
/// Then the prisms of a mesh fill the ground near its surface once: exactly along edges and at convex tips, and but for what is as near to
/// a corner as it is deep at others.
///
/// Neighbours are facets with the same corners that the same body may touch. In the facet's own axes; lengths in m.
namespace yade {

/// One facet of a mesh with those that share corners with it.
class FacetInMesh {
public:
	/// `shift2`: to where body 2, which meets the facet, is in the period of body 1.
	FacetInMesh(const Body& facet, const Body& body2, const Vector3r& shift2, Scene& scene);

	/// The side of the facet on which a point lies; +1 is the side of the normal. Beyond an edge that another facet shares, the facet decides that the
	/// mesh has beside the point: a body that overhangs the edge of a box stands on its top, and the box's side is seen from outside.
	int sideOf(const Vector3r& point) const;

	struct Prism {
		static constexpr int                                back = 1; ///< the second plane
		std::array<polytope::Plane, 5 + pieces::cutsAtTips> planes;
		int                                                 count = 0;
		void                                                add(const Vector3r& normal, const Vector3r& point);
		/// Whether the shape was made of these planes, or of ones that differ by rounding of the neighbours' poses.
		bool made(const polytope::ConvexShape& solid) const;
	};

	/// Front, back, the three sides, and what cuts off what is nearer to others at convex tips.
	Prism prism(int side, const Real& depth) const;

private:
	struct OfMesh {
		Vector3r           corner[3];
		std::array<int, 3> own; ///< the first facet's corner that this one is, or −1
	};

	/// A facet of the mesh beyond the edge of another one: its number, or that of all for none; whether its normal (1) or the opposite (−1) is on the side
	/// +1; and its tilt over that one's plane, towards that side [rad].
	struct Beyond {
		std::size_t facet;
		int         turn;
		Real        tilt;
	};

	Beyond   beyond(std::size_t facet, int edge, int turn) const;
	void     addTilt(const OfMesh& other);
	void     addCutsAt(int corner, const Vector3r& up, Prism& prism) const;
	Vector3r outward(int edge) const;

	const Vector3r& corner(int k) const { return mesh_.front().corner[k]; }

	std::vector<OfMesh>& mesh_;   ///< all facets that the body may touch, first this one
	Vector3r             normal_; ///< on side +1
	Real                 size_;   ///< longest edge
	/// Angles of the neighbours beyond each edge over the facet's plane, towards side +1 [rad]: the lowest and the highest.
	Real lowest_[3], highest_[3];
	bool known_[3] = { false, false, false };
};

/// The ground behind a facet at `centre`, as the others of its mesh leave it, which body 2 touches from `other`: world axes. One face, and what parts it from the
/// others.
void setGround(const Body& facet, const Vector3r& centre, const Body& body2, const Vector3r& other, Scene& scene, Solid& solid);

} // namespace yade
