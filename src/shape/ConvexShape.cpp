// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ConvexShape.hpp"

#include "numbers/NumberText.hpp"
#include "shape/InscribedBall.hpp"
#include "shape/KnownShapes.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace polytope {

namespace {

	template <int D>
	Real findInscribedBall(const HalfSpaces& set, const Real* arrays, int padded, const Real& reach, std::array<int, 4>& planesOfBall,
	        std::optional<LpBasis<Real, D>>& ball)
	{
		InscribedBall<D> inscribed(arrays, padded, int(set.size()), reach);
		if (!inscribed.solve() && !inscribed.solveWithMoreDigits())
			throw std::runtime_error("ConvexShape: the inscribed ball of a bounded set was not found");
		for (int k = 0; k <= D; ++k)
			planesOfBall[std::size_t(k)] = inscribed.basis().plane[k];
		const Real radius = -inscribed.basis().infeasibility;
		if (inscribed.solveAgain()) ball = inscribed.basis();
		return radius;
	}

} // namespace

ConvexShape::ConvexShape(const HalfSpaces& planes, Real cornerRadius, Real thickness)
        : ConvexShape(normalised(planes), polytope::polyhedron(planes, thickness), thickness)
{
	roundCorners(cornerRadius);
}

ConvexShape::ConvexShape(const HalfSpaces& unit, Polyhedron faces, const Real& thickness)
        : planes_(unit), thickness_(thickness), polyhedron_(std::move(faces))
{
	placeVertices(planes_, thickness_, polyhedron_);
	mass_ = massProperties(polyhedron_);
	fillArrays();
	const int D = dimension();
	for (const Vector3& v : polyhedron_.vertices)
		boundingRadius_ = std::max(boundingRadius_, Real(D == 2 ? v.head<2>().norm() : v.norm()));
	// artificial planes must lie outside the ball: it is inside the body. Not as far as the farthest plane: one that no corner of
	// the body reaches may be anywhere, and rounding is proportional to the reach
	const Real reach = 16 * boundingRadius_;
	inscribedRadius_ = D == 3 ? findInscribedBall<3>(planes_, arrays_.data(), padded_, reach, inscribedBasis_, inscribedBall_.second)
	                          : findInscribedBall<2>(planes_, arrays_.data(), padded_, reach, inscribedBasis_, inscribedBall_.first);
}

void ConvexShape::roundCorners(const Real& radius)
{
	if (!isfinite(radius) || radius < 0 || radius >= boundingRadius_)
		throw std::invalid_argument(
		        "cornerRadius: must be at least 0 and fit inside the body, that is, be smaller than the inscribed ball's radius "
		        + numberText(inscribedRadius_) + " m; got " + numberText(radius));
	cornerRadius_ = radius;
}

void ConvexShape::fillArrays() { padded_ = fillPlaneArrays(planes_.normals, planes_.offsets, dimension(), arrays_); }

std::shared_ptr<const ConvexShape> ConvexShape::halfSpace(const Vector3& unitNormal, int dimension)
{
	std::shared_ptr<ConvexShape> wall(new ConvexShape);
	wall->planes_          = { { unitNormal }, { Real(0) }, dimension };
	wall->inscribedRadius_ = wall->boundingRadius_ = wall->thickness_ = std::numeric_limits<Real>::infinity();
	// below padOffset, so neutral planes stay neutral, and far above every slack
	wall->cornerRadius_ = Real(padOffset) / 1e30;
	wall->fillArrays();
	return wall;
}

const Vector3& ConvexShape::support(const Vector3& direction) const
{
	const auto& vertices = polyhedron_.vertices;
	std::size_t farthest = 0;
	for (std::size_t k = 1; k < vertices.size(); ++k)
		if (vertices[k].dot(direction) > vertices[farthest].dot(direction)) farthest = k;
	return vertices[farthest];
}

Real ConvexShape::widthAlong(const Vector3& direction) const
{
	if (polyhedron_.vertices.empty()) return std::numeric_limits<Real>::infinity();
	Real least = polyhedron_.vertices.front().dot(direction), most = least;
	for (const Vector3& vertex : polyhedron_.vertices) {
		const Real place = vertex.dot(direction);
		least            = std::min(least, place);
		most             = std::max(most, place);
	}
	return most - least;
}

namespace {

	struct KnownConvex {
		std::weak_ptr<const ConvexShape> shape;
	};

	KnownShapes<KnownConvex>& knownConvex()
	{
		static KnownShapes<KnownConvex> known;
		return known;
	}

	KnownShapes<KnownConvex>::Key keyOf(const HalfSpaces& planes, const Real& cornerRadius, const Real& thickness)
	{
		KnownShapes<KnownConvex>::Key key { Real(planes.dimension), cornerRadius, thickness };
		key.reserve(3 + 4 * planes.size());
		for (const Vector3& n : planes.normals)
			key.insert(key.end(), { n[0], n[1], n[2] });
		key.insert(key.end(), planes.offsets.begin(), planes.offsets.end());
		return key;
	}

} // namespace

std::shared_ptr<const ConvexShape> ConvexShape::shared(const HalfSpaces& planes, Real cornerRadius, Real thickness)
{
	auto                               key = keyOf(planes, cornerRadius, thickness);
	KnownConvex                        found;
	std::shared_ptr<const ConvexShape> shape;
	if (knownConvex().find(key, found, shape)) return shape;
	shape = std::make_shared<const ConvexShape>(planes, cornerRadius, thickness);
	return knownConvex().keep(std::move(key), { shape }, shape);
}

std::shared_ptr<const ConvexShape> ConvexShape::known(std::shared_ptr<const ConvexShape> shape)
{
	return knownConvex().keep(keyOf(shape->planes_, shape->cornerRadius_, shape->thickness_), { shape }, shape);
}

std::shared_ptr<const ConvexShape> ConvexShape::ofFaces(const HalfSpaces& planes, Polyhedron faces, const std::optional<Real>& cornerRadius,
        const Real& cornerFraction, const Real& thickness)
{
	std::shared_ptr<ConvexShape> shape(new ConvexShape(normalised(planes), std::move(faces), thickness));
	shape->roundCorners(cornerRadius ? *cornerRadius : cornerFraction * shape->inscribedRadius_);
	return known(shape);
}

std::shared_ptr<const ConvexShape> ConvexShape::withCornerRadius(const Real& radius) const
{
	if (radius == cornerRadius_) return shared(planes_, radius, thickness_);
	const auto shape = std::make_shared<ConvexShape>(*this);
	shape->roundCorners(radius);
	return known(shape);
}

} // namespace polytope
