// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/PolytopeFamily.hpp"

#include <src/shape/PlacedShape.hpp>
#include <src/shape/Rings.hpp>

namespace yade {

namespace {

	const Polytope& polytopeFrom(const Shape& shape) { return static_cast<const Polytope&>(shape); }
	Real            marginOf(const Shape& shape) { return polytopeFrom(shape).margin().value_or(0); }

	class PolytopeFamily : public ShapeFamily {
	public:
		Real boundingRadius(const Shape& shape) const override
		{
			const auto& convex = polytopeFrom(shape).convex();
			return convex ? convex->boundingRadius() + marginOf(shape) : Real(0);
		}

		Real inscribedRadius(const Shape& shape) const override
		{
			const auto& convex = polytopeFrom(shape).convex();
			return convex ? convex->inscribedRadius() + marginOf(shape) : ShapeFamily::inscribedRadius(shape);
		}

		/// Half the edge of the cube (square) of its volume (a polygon's area).
		Real size(const Shape& shape) const override
		{
			const auto& convex = polytopeFrom(shape).convex();
			if (!convex) return 0;
			const Real volume = polytopeFrom(shape).volume();
			return convex->dimension() == 2 ? math::sqrt(volume / convex->thickness()) / 2 : math::cbrt(volume) / 2;
		}

		Real projectedArea(const Shape& shape, const Vector3r& direction) const override
		{
			const auto hull = surface(shape);
			if (!hull) return 0;
			Real twice = 0;
			for (std::size_t k = 0; k < hull->faces.size(); ++k)
				twice += math::abs(polytope::faceArea(*hull, k).dot(direction));
			return twice / 2;
		}

		void extend(const Shape& shape, const State& state, Vector3r& low, Vector3r& high) const override
		{
			const auto& convex = polytopeFrom(shape).convex();
			if (!convex) return ShapeFamily::extend(shape, state, low, high);
			Vector3r ownLow = Vector3r::Constant(std::numeric_limits<Real>::infinity()), ownHigh = -ownLow;
			extendBy(convex->polyhedron().vertices, state, ownLow, ownHigh);
			const Vector3r margin = Vector3r::Constant(marginOf(shape));
			low                   = low.cwiseMin(Vector3r(ownLow - margin));
			high                  = high.cwiseMax(Vector3r(ownHigh + margin));
		}

		void addSupport(const Shape& shape, const Placing& placing, Solid& solid) const override
		{
			const auto& convex = polytopeFrom(shape).convex();
			if (!convex || !(placing.centre.norm() < boundingRadius(shape) + placing.near)) return;
			const std::size_t first = solid.planes.size();
			polytope::addPlanesOf({ *convex, placing.centre, placing.rotation }, solid.planes);
			const Real margin = marginOf(shape);
			for (std::size_t k = first; margin > 0 && k < solid.planes.size(); ++k)
				solid.planes[k].offset += margin;
			solid.faces = solid.planes.size();
		}

		std::optional<CoreOfBody> core(
		        const Shape& shape, const Vector3r& position, const Quaternionr& orientation, const Vector3r&) const override
		{
			const std::optional<Real> margin = polytopeFrom(shape).margin();
			const auto&               convex = polytopeFrom(shape).convex();
			if (!margin || !convex || convex->dimension() != 3) return std::nullopt;
			return CoreOfBody { convex, *margin, position, orientation.toRotationMatrix() };
		}

		std::shared_ptr<const polytope::Polyhedron> surface(const Shape& shape) const override
		{
			return polytopeFrom(shape).surface();
		}
	};

} // namespace

std::unique_ptr<const ShapeFamily> familyOfPolytopes() { return std::make_unique<PolytopeFamily>(); }

} // namespace yade
