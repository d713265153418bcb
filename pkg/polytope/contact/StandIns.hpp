// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeom.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>

/// Half-spaces that stand for YADE's boxes and facets where they are met: made for each pair, kept in its geometry (StandIn::partner), and
/// made anew where the shape, or the mesh around a facet, has changed. Null: there is no such solid.
namespace yade {

/// \param cornerRadius of the body that meets it [m]
void standForBox(const Box& box, Real cornerRadius, StandIn& standIn);

/// The ground behind a facet (FacetPrism.hpp).
/// \param other     the body that meets it, `shift`: what moves that into the facet's period
/// \param anew      the contact begins: then the side is settled on which it is
/// \param depth     of the ground [m]
void standForFacet(const Body& facet, const Body& other, const Vector3r& shift, Scene& scene, bool anew, Real depth, Real cornerRadius,
        StandIn& standIn);

} // namespace yade
