// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <src/shape/ConvexShape.hpp>

/// A sphere that lies on several polytopes where they meet: plates that lie flush, wedges along a ridge, bricks at a corner.
///
/// Each pair knows the distance from the sphere's centre to its own polytope alone. Where the polytopes meet, all of them have the same
/// nearest point, or, beside the joint, those behind it have one on their edge that is covered by the piece in front. As many springs would
/// act as there are pieces. So a contact whose nearest point lies on another piece that is nearer gets that piece's point and normal:
/// together they touch where their union does. And each has a share of the stiffness: the part of the disc in which the sphere is cut, half
/// as deep as it overlaps, that lies in its piece, of what lies in all. A disc that lies in one piece alone has all of it, so a sphere in a
/// valley rests on two full springs, and shares change without a jump.
///
/// It follows from poses and shapes alone, so pieces may be fixed, free or parts of clumps. YADE's own boxes and facets meet spheres by
/// YADE's functors, which know no shares.
namespace yade {

/// Where a sphere is nearest to a solid: from the sphere's centre, world axes.
struct NearestOfSphere {
	Vector3r point;
	Vector3r outward; ///< unit, from the solid
	Real     distance;
};

NearestOfSphere nearestOfSphere(const polytope::ConvexShape& solid, const Vector3r& centre, const Quaternionr& orientation);

/// Square of the radius of the disc in which a sphere is cut half as deep as it overlaps.
Real discRadiusSquared(const Real& radius, const Real& depth);

/// Energy of a sphere's contact whose stiffness is one per that disc's area A, over the present stiffness and the square of the depth h:
/// ∫ A h dh / (A h²). A linear spring has 1/2.
Real energyOfSpherePerArea(const Real& radius, const Real& depth);

/// For a sphere in contact with a piece: replaces the nearest point of the piece by that of all pieces that meet there. Returns the
/// contact's share of the stiffness.
Real shareOfSphere(
        const Body& sphere, const Real& radius, const Body& piece, const Vector3r& centre, Scene& scene, NearestOfSphere& nearest);

} // namespace yade
