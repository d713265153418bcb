// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/WallShape.hpp"

#include <array>

namespace yade {

Vector3r outwardOf(const Wall& wall, const Vector3r& way)
{
	const Real side = wall.sense != 0 ? Real(wall.sense) : way[wall.axis];
	return (side < 0 ? -1 : 1) * Vector3r::Unit(wall.axis);
}

Vector3r footOn(const Wall& wall, const Vector3r& position, const Vector3r& place)
{
	Vector3r foot   = place;
	foot[wall.axis] = position[wall.axis];
	return foot;
}

namespace {

	using HalfSpace = std::shared_ptr<const polytope::ConvexShape>;

	/// The half-spaces of walls along each axis, to the negative and to the positive side: made once, so that a contact allocates nothing.
	std::array<HalfSpace, 6> madeHalfSpaces()
	{
		std::array<HalfSpace, 6> all;
		for (int k = 0; k < 6; ++k)
			all[std::size_t(k)] = polytope::ConvexShape::halfSpace((k % 2 ? 1 : -1) * Vector3r::Unit(k / 2), 3);
		return all;
	}

	class WallFamily : public ShapeFamily {
	public:
		void extend(const Shape& shape, const State& state, Vector3r& low, Vector3r& high) const override
		{
			const int axis = static_cast<const Wall&>(shape).axis;
			for (int k = 0; k < 3; ++k) {
				low[k]  = k == axis ? math::min(low[k], state.pos[k]) : -std::numeric_limits<Real>::infinity();
				high[k] = k == axis ? math::max(high[k], state.pos[k]) : std::numeric_limits<Real>::infinity();
			}
		}

		void addSupport(const Shape& shape, const Placing& placing, Solid& solid) const override
		{
			const Vector3r normal = outwardOf(static_cast<const Wall&>(shape), placing.other - placing.centre);
			solid.planes.push_back({ normal, normal.dot(placing.centre) });
			solid.faces = solid.planes.size();
		}

		std::optional<CoreOfBody> core(
		        const Shape& shape, const Vector3r& position, const Quaternionr&, const Vector3r& other) const override
		{
			const auto&    wall     = static_cast<const Wall&>(shape);
			const Vector3r outward  = outwardOf(wall, other - position);
			const int      positive = outward[wall.axis] > 0 ? 1 : 0;
			return CoreOfBody { halfSpaces_[std::size_t(2 * wall.axis + positive)], 0, footOn(wall, position, other),
				Matrix3r::Identity() };
		}

	private:
		std::array<HalfSpace, 6> halfSpaces_ = madeHalfSpaces();
	};

} // namespace

std::unique_ptr<const ShapeFamily> familyOfWalls() { return std::make_unique<WallFamily>(); }

} // namespace yade
