// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/Preconditions.hpp"

#include "centre/IpoptCentre.hpp"
#include "numbers/NumberText.hpp"

namespace polytope {

namespace {

	bool isRotation(const Matrix3& matrix, int dimension)
	{
		const Matrix3 rest = matrix.transpose() * matrix - Matrix3::Identity();
		if (!(rest.cwiseAbs().maxCoeff() <= Real(tolerance::orthogonal)) || !(matrix.determinant() > 0))
			return false; // also what is no number
		return dimension == 3 || abs(matrix(2, 2) - 1) <= Real(tolerance::orthogonal);
	}

	/// Whether the normal of a half-space, which takes it as it is given, has the length 1; other shapes always pass.
	bool hasUnitNormal(const ConvexShape& shape)
	{
		if (isfinite(shape.boundingRadius())) return true;
		const Vector3& normal = shape.planes().normals.front();
		return abs(normal.squaredNorm() - 1) <= Real(tolerance::orthogonal) && (shape.dimension() == 3 || normal[2] == 0);
	}

	/// Whether it is one of the values from 0 to the last: a program may have made it of an integer.
	template <class Choice> bool isOneUpTo(Choice value, Choice last) { return int(value) >= 0 && int(value) <= int(last); }

	std::string faultOf(const InternalPlanes& planes, const ConvexShape& shape1, const ConvexShape& shape2)
	{
		for (int body = 0; body < 2; ++body) {
			const std::string shape = "shape" + std::to_string(body + 1);
			if (planes.count[body] < 0 || planes.count[body] > InternalPlanes::most)
				return "settings.internal: a body has room for " + std::to_string(InternalPlanes::most)
				        + " internal planes";
			for (int k = 0; k < planes.count[body]; ++k)
				if (planes.plane[body][k] < 0 || planes.plane[body][k] >= (body ? shape2 : shape1).planeCount())
					return "settings.internal: " + shape + " has no plane " + std::to_string(planes.plane[body][k]);
			if (planes.ends[body] < 0 || planes.ends[body] > InternalPlanes::mostEnds)
				return "settings.internal: a body has room for " + std::to_string(InternalPlanes::mostEnds)
				        + " planes of its solid's other pieces";
			for (int k = 0; k < planes.ends[body]; ++k) {
				const Plane& end = planes.end[body][k];
				if (!(abs(end.normal.squaredNorm() - 1) <= Real(tolerance::orthogonal)) || !isfinite(end.offset))
					return "settings.internal: planes of the solid of " + shape
					        + " must have unit normals and finite offsets [m]";
			}
			if (!(planes.radius[body] > 0))
				return "settings.internal: the radius of the overlap about " + shape + " must be positive [m], or infinite";
		}
		return "";
	}

} // namespace

std::string faultOf(const ContactOptions& options)
{
	if (!isOneUpTo(options.contactModel, ContactModel::Spring)) return "contactModel: must be one of ContactModel";
	if (!isOneUpTo(options.contactPoint, ContactPoint::Centroid)) return "contactPoint: must be one of ContactPoint";
	if (!isOneUpTo(options.solver, CentreSolver::Ipopt)) return "solver: must be one of CentreSolver";
	if (options.solver == CentreSolver::Ipopt && !ipoptVersion())
		return "solver: this build has no Ipopt; use 'newton', or install Ipopt (Debian: coinor-libipopt-dev) and build again with "
		       "-DPOLYTOPE_IPOPT=ON";
	if (!(options.tolerance >= 0 && options.tolerance < 1))
		return "tolerance: must be at least 0 and below 1 (a fraction of the smaller body's circumradius)";
	const Real least = tolerance::rounding, most = tolerance::coarsestNewton;
	if (!(options.newtonTolerance >= least && options.newtonTolerance <= most))
		return "newtonTolerance: must lie between " + numberText(least) + " (the rounding of this precision's numbers) and "
		        + numberText(most) + " (a fraction of the overlap's own size)";
	return "";
}

std::string faultOf(const PlacedPair& pair, const ContactSettings& settings)
{
	const ConvexShape &shape1 = *pair.shape[0], &shape2 = *pair.shape[1];
	const std::string  fault = faultOf(settings);
	if (!fault.empty()) return fault;
	const Real sum = settings.normalWeight[0] + settings.normalWeight[1];
	if (!(settings.normalWeight[0] >= 0 && settings.normalWeight[1] >= 0 && sum > 0 && isfinite(sum)))
		return "normalWeight: must be two finite numbers of at least 0, not both 0";
	const int dimension = shape1.dimension();
	if (dimension != shape2.dimension()) return "shape2: a polygon and a polyhedron cannot touch; both must have the same dimension";
	if (!isfinite(shape1.boundingRadius()) && !isfinite(shape2.boundingRadius()))
		return "shape2: two half-spaces cannot touch; one of both must be bounded";
	const char* const unit = ": the normal of a half-space must be a unit vector, in 2-D with z = 0";
	if (!hasUnitNormal(shape1)) return std::string("shape1") + unit;
	if (!hasUnitNormal(shape2)) return std::string("shape2") + unit;
	const char* const what = dimension == 3 ? ": must be a rotation matrix" : ": must be the matrix of a rotation about z";
	if (!isRotation(*pair.rotation[0], dimension)) return std::string("rotation1") + what;
	if (!isRotation(*pair.rotation[1], dimension)) return std::string("rotation2") + what;
	for (int k = 0; k < dimension; ++k)
		if (!isfinite((*pair.centre2)[k])) return "centre2: must be finite";
	return settings.internal ? faultOf(*settings.internal, shape1, shape2) : "";
}

} // namespace polytope
