// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/StandIns.hpp"

#include "contact/FacetPrism.hpp"
#include "shape/BoxShape.hpp"

#include <src/shape/ShapeOrNull.hpp>

namespace yade {

namespace {

	std::shared_ptr<const polytope::ConvexShape> solidOf(const FacetInMesh::Prism& prism, Real cornerRadius)
	{
		polytope::HalfSpaces set;
		for (int i = 0; i < prism.count; ++i) {
			set.normals.push_back(prism.planes[size_t(i)].normal);
			set.offsets.push_back(prism.planes[size_t(i)].offset);
		}
		const auto solid = polytope::ConvexShape::shared(set, 0);
		return solid->withCornerRadius(math::min(cornerRadius, Real(solid->inscribedRadius() / 2)));
	}

} // namespace

void standForBox(const Box& box, Real cornerRadius, StandIn& standIn)
{
	// scripts may change the extents of a box in a run
	if (standIn.partner && isMadeOf(*standIn.partner, box)) return;
	const Real radius = math::min(cornerRadius, Real(box.extents.minCoeff() / 2));
	standIn.partner   = polytope::shapeOrNull([&] { return polytope::ConvexShape::shared(halfSpacesOf(box), radius); });
}

void standForFacet(const Body& facet, const Body& other, const Vector3r& shift, Scene& scene, bool anew, Real depth, Real cornerRadius,
        StandIn& standIn)
{
	const FacetInMesh mesh(facet, other, shift, scene);
	// the side is settled when the contact begins, and kept while it lasts
	if (!standIn.partner || anew)
		standIn.side = mesh.sideOf(facet.state->ori.conjugate() * (other.state->pos + shift - facet.state->pos));
	// nor need its corners be the same as in the step before
	const FacetInMesh::Prism prism = mesh.prism(standIn.side, depth);
	if (standIn.partner && prism.made(*standIn.partner)) return;
	standIn.partner = polytope::shapeOrNull([&] { return solidOf(prism, cornerRadius); });
}

} // namespace yade
