// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/FacetShape.hpp"

namespace yade {

namespace {

	const std::vector<Vector3r>& cornersOf(const Shape& shape) { return static_cast<const Facet&>(shape).vertices; }

	class FacetFamily : public ShapeFamily {
	public:
		Real boundingRadius(const Shape& shape) const override
		{
			Real farthest = 0;
			for (const Vector3r& vertex : cornersOf(shape))
				farthest = math::max(farthest, vertex.norm());
			return farthest;
		}

		void extend(const Shape& shape, const State& state, Vector3r& low, Vector3r& high) const override
		{
			extendBy(cornersOf(shape), state, low, high);
		}

		/// The support is as deep as necessary, on the side away from the other body.
		void addSupport(const Shape& shape, const Placing& placing, Solid& solid) const override
		{
			Vector3r corners[3];
			for (int k = 0; k < 3; ++k)
				corners[k] = placing.centre + placing.rotation * cornersOf(shape)[std::size_t(k)];
			const auto corner = [&](int k) -> const Vector3r& { return corners[k]; };
			Vector3r   normal = normalOfTriangle(corner);
			if (normal.dot(placing.other - corners[0]) < 0) normal = -normal;
			solid.planes.push_back({ normal, normal.dot(corners[0]) });
			solid.faces = solid.planes.size();
			for (int k = 0; k < 3; ++k) {
				const Vector3r out = outwardOfEdge(corner, normal, k);
				solid.planes.push_back({ out, out.dot(corners[k]) });
			}
		}

		std::shared_ptr<const polytope::Polyhedron> surface(const Shape& shape) const override
		{
			return std::make_shared<const polytope::Polyhedron>(
			        polytope::Polyhedron { cornersOf(shape), { { 0, 1, 2 } }, { 0 } });
		}
	};

} // namespace

std::unique_ptr<const ShapeFamily> familyOfFacets() { return std::make_unique<FacetFamily>(); }

} // namespace yade
