// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ShapeFamily.hpp"

#include "shape/BoxShape.hpp"
#include "shape/FacetShape.hpp"
#include "shape/PolytopeFamily.hpp"
#include "shape/SphereShape.hpp"
#include "shape/WallShape.hpp"

namespace yade {

namespace {

	/// The families, by class index.
	using Families = std::vector<std::unique_ptr<const ShapeFamily>>;

	void keep(Families& all, int classIndex, std::unique_ptr<const ShapeFamily> family)
	{
		if (classIndex < 0) throw std::logic_error("a class of shapes with a family must call createIndex() in its constructor");
		if (std::size_t(classIndex) >= all.size()) all.resize(std::size_t(classIndex) + 1);
		all[std::size_t(classIndex)] = std::move(family);
	}

	Families ofThePlugIn()
	{
		Families all;
		keep(all, Box().getClassIndex(), familyOfBoxes());
		keep(all, Facet().getClassIndex(), familyOfFacets());
		keep(all, Polytope().getClassIndex(), familyOfPolytopes());
		keep(all, Sphere().getClassIndex(), familyOfSpheres());
		keep(all, Wall().getClassIndex(), familyOfWalls());
		return all;
	}

	/// Made when first asked for: YADE's class indices are given as objects of the classes are made.
	Families& families()
	{
		static Families all = ofThePlugIn();
		return all;
	}

} // namespace

void ShapeFamily::extend(const Shape& shape, const State& state, Vector3r& low, Vector3r& high) const
{
	const Vector3r half = Vector3r::Constant(boundingRadius(shape));
	low                 = low.cwiseMin(Vector3r(state.pos - half));
	high                = high.cwiseMax(Vector3r(state.pos + half));
}

void ShapeFamily::addForce(const Body& body, const Vector3r& place, const Vector3r& force, ForceContainer& forces) const
{
	forces.addForce(body.id, force);
	forces.addTorque(body.id, Vector3r(place - body.state->pos).cross(force));
}

const ShapeFamily& familyOf(const Shape& shape)
{
	static const ShapeFamily unknown;
	const Families&          all   = families();
	int                      index = shape.getClassIndex();
	for (int depth = 1; index >= 0; ++depth) { // Shape itself has none
		if (std::size_t(index) < all.size() && all[std::size_t(index)]) return *all[std::size_t(index)];
		index = shape.getBaseClassIndex(depth);
	}
	return unknown;
}

std::string faultOfFamily(const Shape& shape)
{
	const ShapeFamily& family = familyOf(shape);
	const auto         length = [](const Real& value) { return math::isfinite(value) && value >= 0; };
	if (!length(family.boundingRadius(shape))) return "its bounding radius must be finite and at least 0";
	if (!(family.inscribedRadius(shape) >= 0)) return "the radius of the largest ball in it must be a number and at least 0";
	if (!length(family.size(shape))) return "its size must be finite and at least 0";
	const auto core = family.core(shape, Vector3r::Zero(), Quaternionr::Identity(), Vector3r::UnitX());
	if (core && !length(core->margin)) return "its margin must be finite and at least 0";
	if (core && !(math::isfinite(core->origin.sum()) && math::isfinite(core->way.sum()))) return "its core must have finite ends";
	return "";
}

void registerFamily(int classIndex, std::unique_ptr<const ShapeFamily> family) { keep(families(), classIndex, std::move(family)); }

} // namespace yade
