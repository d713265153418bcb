// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/SolidOfPieces.hpp"

#include <algorithm>
#include <vector>

/// The overlap of two solids that pieces make, as far as their faces are known, as a polyhedron.
namespace yade {

class OverlapOfSolids {
public:
	/// Between all faces that are not internal. `flat`: of polygons, whose depth does not matter; `reach`: no point of it is farther.
	///
	/// Blocks that were cut from one mass have faces in one plane, and rounding says which body's bounds the overlap. There it is that of a body with pieces,
	/// which may be internal, and the touching piece's own before its neighbours'.
	OverlapOfSolids(const SolidOfPieces (&solids)[2], bool flat, const Real& reach);

	struct Face {
		int                   body;   ///< that it lies on a face of; −1: on none
		std::size_t           number; ///< of that face
		std::vector<Vector3r> corners;
		Vector3r              middle;
		Vector3r              area;   ///< along the normal [m²]
		bool                  isThin; ///< no wider than rounding: nothing can be said of it, and nothing presses on it
	};

	/// Corners of all faces, one after the other.
	const std::vector<Vector3r>& corners() const { return corners_; }

	/// Calls visit(face) for those that lie on a face of a body.
	template <class Visit> void forFaces(const Visit& visit) const
	{
		for (const Face& face : faces_)
			if (face.body >= 0) visit(face);
	}
	/// Calls visit(number of the face beside it, its two ends) for the edges of a face with other faces of the same body.
	template <class Visit> void forEdges(const Face& face, const Visit& visit) const
	{
		for (const Face& beside : faces_) {
			if (beside.body != face.body || &beside == &face) continue;
			const auto has = [&](const Vector3r& corner) { // faces that meet have the same corners
				return std::find(beside.corners.begin(), beside.corners.end(), corner) != beside.corners.end();
			};
			for (std::size_t k = 0; k < face.corners.size(); ++k) {
				const Vector3r &one = face.corners[k], &other = face.corners[(k + 1) % face.corners.size()];
				if (has(one) && has(other)) visit(beside.number, one, other);
			}
		}
	}

	/// Its extent inwards from a plane that bounds it.
	Real widthFrom(const polytope::Plane& plane) const;
	/// Not less than the radius of the largest ball in it.
	Real thickness() const;
	/// The mean of its corners.
	Vector3r middle() const;

private:
	std::vector<Face>     faces_;
	std::vector<Vector3r> corners_;
};

} // namespace yade
