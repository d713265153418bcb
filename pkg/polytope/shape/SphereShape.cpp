// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/SphereShape.hpp"

#include <lib/high-precision/Constants.hpp>

namespace yade {

namespace {

	Real radiusOf(const Shape& shape) { return static_cast<const Sphere&>(shape).radius; }

	class SphereFamily : public ShapeFamily {
	public:
		Real boundingRadius(const Shape& shape) const override { return radiusOf(shape); }
		Real inscribedRadius(const Shape& shape) const override { return radiusOf(shape); }
		Real size(const Shape& shape) const override { return radiusOf(shape); }
		Real projectedArea(const Shape& shape, const Vector3r&) const override
		{
			return Mathr::PI * radiusOf(shape) * radiusOf(shape);
		}
		std::optional<CoreOfBody> core(
		        const Shape& shape, const Vector3r& position, const Quaternionr&, const Vector3r&) const override
		{
			return CoreOfBody { nullptr, radiusOf(shape), position, Matrix3r::Identity() };
		}
		bool isRound(const Shape&) const override { return true; }
	};

} // namespace

std::unique_ptr<const ShapeFamily> familyOfSpheres() { return std::make_unique<SphereFamily>(); }

} // namespace yade
