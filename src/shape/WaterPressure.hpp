// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/PlacedShape.hpp"

#include <array>
#include <vector>

/// The load of water on the faces of a body: integrals of a pressure that is linear in pieces, over the faces as they are.
namespace polytope {

/// A pressure value + gradient·(x − point) [Pa] where that is positive, at points with side·(x − point) ≤ offset for each side.
struct PressurePiece {
	/// What bounds a piece: a triangle of the water table seen from above, or a strip.
	struct Side {
		Vector3 normal; ///< unit
		Real    offset;
	};
	static constexpr int mostSides = 3;

	Vector3                     point;
	Vector3                     gradient;
	Real                        value;
	std::array<Side, mostSides> sides;
	int                         sideCount = 0;
};

/// Force, and its moment about the body's centre, along the world's axes.
struct WaterLoad {
	Vector3 force  = Vector3::Zero();
	Vector3 torque = Vector3::Zero();
};

/// Corners of a face that is being clipped, to be used again: no memory is taken for shapes of so many vertices.
struct ClippedFace {
	std::vector<Vector3> corners, rest;
	void                 holdFaceOf(std::size_t vertices);
};

/// The load that these pieces put on the faces of a body; the pieces' points are given from the same origin as the body's centre. Each face
/// is clipped by the sides and by p = 0, then its triangles are integrated exactly: ∫ p dA = A (p₁ + p₂ + p₃)/3, ∫ p x dA = A ((Σ p)(Σ x) +
/// Σ pᵢ xᵢ)/12. The load of a polygon is that on its edges over its thickness. `wet`: planes whose faces have water on them, ascending;
/// null: all.
WaterLoad waterLoad(const PlacedShape& body, const std::vector<PressurePiece>& pieces, const std::vector<int>* wet, ClippedFace& memory);

} // namespace polytope
