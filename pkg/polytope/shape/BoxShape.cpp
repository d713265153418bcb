// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/BoxShape.hpp"

namespace yade {

bool isMadeOf(const polytope::ConvexShape& solid, const Box& box)
{
	const auto& offsets = solid.planes().offsets;
	return offsets[0] == box.extents[0] && offsets[2] == box.extents[1] && offsets[4] == box.extents[2];
}

namespace {

	const Vector3r& halfOf(const Shape& shape) { return static_cast<const Box&>(shape).extents; }

	class BoxFamily : public ShapeFamily {
	public:
		Real boundingRadius(const Shape& shape) const override { return halfOf(shape).norm(); }
		Real inscribedRadius(const Shape& shape) const override { return halfOf(shape).minCoeff(); }

		Real projectedArea(const Shape& shape, const Vector3r& direction) const override
		{
			const Vector3r& e = halfOf(shape);
			return 4 * Vector3r(e[1] * e[2], e[2] * e[0], e[0] * e[1]).dot(direction.cwiseAbs());
		}

		void extend(const Shape& shape, const State& state, Vector3r& low, Vector3r& high) const override
		{
			const Vector3r half = state.ori.toRotationMatrix().cwiseAbs() * halfOf(shape);
			low                 = low.cwiseMin(Vector3r(state.pos - half));
			high                = high.cwiseMax(Vector3r(state.pos + half));
		}

		void addSupport(const Shape& shape, const Placing& placing, Solid& solid) const override
		{
			if (!(placing.centre.norm() < boundingRadius(shape) + placing.near)) return;
			polytope::forPlanesOfCuboid(halfOf(shape), [&](int axis, int sign, const Real& offset) {
				const Vector3r normal = sign * placing.rotation.col(axis);
				solid.planes.push_back({ normal, offset + normal.dot(placing.centre) });
			});
			solid.faces = solid.planes.size();
		}

		std::shared_ptr<const polytope::Polyhedron> surface(const Shape& shape) const override
		{
			polytope::Polyhedron faces;
			for (int corner = 0; corner < 8; ++corner)
				faces.vertices.push_back(Vector3r(corner & 4 ? 1 : -1, corner & 2 ? 1 : -1, corner & 1 ? 1 : -1)
				                .cwiseProduct(halfOf(shape)));
			faces.faces = { { 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 4, 5, 1 }, { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 5, 7, 3 } };
			faces.planeOfFace = { 1, 0, 3, 2, 5, 4 };
			return std::make_shared<const polytope::Polyhedron>(std::move(faces));
		}
	};

} // namespace

std::unique_ptr<const ShapeFamily> familyOfBoxes() { return std::make_unique<BoxFamily>(); }

} // namespace yade
