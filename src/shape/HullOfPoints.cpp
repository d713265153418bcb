// SPDX-License-Identifier: GPL-2.0-or-later
#include "numbers/NumberText.hpp"
#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"
#include "shape/PlaneMeeting.hpp"
#include "shape/ShapeConstruction.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

#include <cmath>
#include <string>

// hullOf: the points are brought to unit size about the middle of their box, the exact hull's triangles are joined into
// facets (TriangleClusters.hpp), and each facet's plane is fitted to all of its points. In 2-D the polygon is made a prism first.
namespace polytope {
namespace {

	struct UnitPoints {
		std::vector<Vector3> points;
		Vector3              centre;
		Real                 unit;   ///< a power of two: points · unit + centre are the caller's
		Real                 extent; ///< in units, about the centre
		Real size; ///< in units: extent, or distance of the centre from the origin, which the points' rounding goes with
	};

	void check(const std::vector<Vector3>& points, int dimension, const Real& coplanar)
	{
		if (dimension != 2 && dimension != 3) refuse("dimension: " + std::to_string(dimension) + "; give 2 or 3");
		if (points.size() < std::size_t(dimension) + 1)
			refuse("points: " + std::to_string(points.size()) + " cannot span a body in " + std::to_string(dimension)
			        + "-D; give at least " + std::to_string(dimension + 1));
		for (std::size_t i = 0; i < points.size(); ++i)
			for (int k = 0; k < 3; ++k)
				if (!finite(points[i][k]))
					refuse("points: entry " + std::to_string(i)
					        + " (counted from 0) is not finite; remove NaN and infinite values");
				else if (magnitude(points[i][k]) > construction::largestLength)
					refuse("points: entry " + std::to_string(i)
					        + " (counted from 0) is beyond 1e50; choose another unit of length");
		if (!(coplanar >= 0 && coplanar <= Real(0.1)))
			refuse("coplanar: it must lie between 0 and 0.1; it is a fraction of the extent");
	}

	[[noreturn]] void refuseFlat(int dimension)
	{
		refuse(dimension == 2
		                ? "points: they lie on a line; give at least three corners of a polygon"
		                : "points: they lie in a plane; give points that span a volume (for a polygon use yade.polytope.polygon)");
	}

	UnitPoints atUnitSize(const std::vector<Vector3>& points, int dimension)
	{
		Eigen::AlignedBox<Real, 3> box(points.front());
		for (const Vector3& p : points)
			box.extend(p);
		const Vector3 low = box.min(), high = box.max(), span = box.sizes();
		const int     used    = dimension; // in 2-D the extent is that of x and y
		const Real    largest = span.head(used).maxCoeff();
		if (!(largest > 0)) refuseFlat(dimension);
		if (largest < construction::smallestLength)
			refuse("points: they are less than " + numberText(construction::smallestLength)
			        + " apart; choose another unit of length");
		using std::frexp;
		using std::ldexp;
		int exponent = 0;
		frexp(largest, &exponent);

		UnitPoints result;
		result.unit   = ldexp(Real(1), exponent);
		result.centre = low + span / 2;
		if (dimension == 2) {
			if (std::max(magnitude(low.z()), magnitude(high.z())) > construction::outOfPlane * largest)
				refuse("points: in 2-D they lie in the xy plane; give z = 0");
			result.centre.z() = 0;
		}
		result.extent = 0;
		for (const Vector3& p : points) {
			Vector3 q     = (p - result.centre) / result.unit;
			result.extent = std::max(result.extent, q.norm());
			if (dimension == 3) {
				result.points.push_back(q);
				continue;
			}
			for (int side = -1; side <= 1; side += 2)
				result.points.emplace_back(q.x(), q.y(), Real(side));
		}
		result.size = std::max(result.extent, Real(result.centre.norm() / result.unit));
		return result;
	}

	/// The plane nearest to points (least squares).
	struct Fit {
		Vector3 normal;
		Vector3 middle;
		Real    misfit; ///< largest distance of a point from it
		Real    width;  ///< root of the second largest moment of the points: near zero for points on a line
	};

	/// The plane of a triangle by a cross product. False if the triangle is a sliver.
	bool fitOfTriangle(const std::vector<Vector3>& points, const Indices& members, Fit& fit)
	{
		const Vector3 &a = points[std::size_t(members[0])], &b = points[std::size_t(members[1])],
		              &c = points[std::size_t(members[2])];
		const Vector3 ab = b - a, ac = c - a;
		const Real    longest = std::max({ ab.squaredNorm(), ac.squaredNorm(), Real((c - b).squaredNorm()) });
		fit.normal            = ab.cross(ac);
		const Real area2      = fit.normal.norm(); // twice the area
		if (!(area2 >= construction::sliver * longest)) return false;
		fit.normal /= area2;
		fit.middle = (a + b + c) / 3;
		fit.misfit = 0;
		// moments m1 ≥ m2 about the middle: m1 m2 = area2² / 3, m1 + m2 = a third of the squared edges
		const Real sum     = (ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm()) / 3;
		const Real product = area2 * area2 / 3;
		const Real rest    = sum * sum / 4 - product;
		fit.width          = sqrt(product / (sum / 2 + sqrt(rest > 0 ? rest : Real(0))));
		return true;
	}

	/// Whether four points certainly miss every plane by more than the tolerance: a tetrahedron's width is its volume over the
	/// largest of its triangles' and its two opposite edges' areas, and at best half of it is missed.
	bool missEachOther(const std::vector<Vector3>& points, const std::array<int, 4>& corners, const Real& tolerance)
	{
		const Vector3& o = points[std::size_t(corners[3])];
		const Vector3  a = points[std::size_t(corners[0])] - o, b = points[std::size_t(corners[1])] - o,
		              c  = points[std::size_t(corners[2])] - o;
		const Vector3 ab = a.cross(b), bc = b.cross(c), ca = c.cross(a);
		const Real largest = std::max({ ab.norm(), bc.norm(), ca.norm(), Real((ab + bc + ca).norm()), Real(a.cross(c - b).norm()),
		        Real(b.cross(c - a).norm()), Real(c.cross(b - a).norm()) });
		const Real rounded = construction::minorRounding * a.norm() * b.norm() * c.norm();
		return abs(c.dot(ab)) - rounded > 2 * tolerance * largest * (1 + construction::minorRounding);
	}

	/// Fits a plane by QR and the singular values of its 3 × 3 factor: the scatter matrix would square the condition and lose thin facets.
	Fit planeFit(const std::vector<Vector3>& points, const Indices& members)
	{
		Fit fit;
		if (members.size() == 3 && fitOfTriangle(points, members, fit)) return fit;
		fit.middle = Vector3::Zero();
		for (int i : members)
			fit.middle += points[std::size_t(i)] / Real(members.size());
		using Rows = Eigen::Matrix<Real, Eigen::Dynamic, 3>;
		Rows rows(Eigen::Index(members.size()), 3);
		for (std::size_t k = 0; k < members.size(); ++k)
			rows.row(Eigen::Index(k)) = (points[std::size_t(members[k])] - fit.middle).transpose();
		const Eigen::HouseholderQR<Rows> qr(rows);
		const Matrix3                    factor = qr.matrixQR().template topRows<3>().template triangularView<Eigen::Upper>();
		const Eigen::JacobiSVD<Matrix3>  svd(factor, Eigen::ComputeFullV);
		fit.normal = svd.matrixV().col(2);
		fit.width  = svd.singularValues()[1];
		fit.misfit = (rows * fit.normal).cwiseAbs().maxCoeff();
		return fit;
	}

	Indices everyIndex(std::size_t count)
	{
		Indices all(count);
		std::iota(all.begin(), all.end(), 0);
		return all;
	}

	/// A fit whose normal points away from `inner`.
	Fit outwardFit(const std::vector<Vector3>& points, const Indices& members, const Vector3& inner)
	{
		Fit fit = planeFit(points, members);
		if (fit.normal.dot(fit.middle - inner) < 0) fit.normal = -fit.normal;
		return fit;
	}

	/// The supporting plane of one facet in the caller's frame.
	void addPlane(HalfSpaces& planes, const UnitPoints& set, const Indices& members, const Fit& fit)
	{
		Vector3 normal = fit.normal;
		if (planes.dimension == 2) {
			if (magnitude(normal.z()) > Real(0.5)) return; // a cap of the prism
			normal.z() = 0;
		}
		normal.normalize();
		Real reach = normal.dot(set.points[std::size_t(members.front())]);
		for (int i : members)
			reach = std::max(reach, Real(normal.dot(set.points[std::size_t(i)])));
		planes.normals.push_back(normal);
		planes.offsets.push_back(reach * set.unit + normal.dot(set.centre));
	}

	/// The middle of the hull's triangles: not of all points, which may be concentrated in a corner.
	Vector3 innerPoint(const std::vector<Vector3>& points, const Triangles& triangles)
	{
		Vector3 inner = Vector3::Zero();
		for (const Triangle& t : triangles)
			for (int corner : t)
				inner += points[std::size_t(corner)] / Real(3 * triangles.size());
		return inner;
	}

	/// The points that are corners of a triangle, each once.
	Indices cornersOf(const Triangles& triangles)
	{
		Indices corners;
		for (const Triangle& t : triangles)
			corners.insert(corners.end(), t.begin(), t.end());
		std::sort(corners.begin(), corners.end());
		corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
		return corners;
	}

} // namespace

HalfSpaces hullOf(const std::vector<Vector3>& points, int dimension, Real coplanar)
{
	check(points, dimension, coplanar);
	const UnitPoints set = atUnitSize(points, dimension);
	// the fitted plane's misfit is at least half the set's width, and at most a few times that
	const Real halfWidth = planeFit(set.points, everyIndex(set.points.size())).misfit;
	if (halfWidth <= construction::flatness * set.size) refuseFlat(dimension);

	const Triangles triangles = hullTriangles(set.points);
	const Edges     edges(triangles);
	const Vector3   inner     = innerPoint(set.points, triangles);
	const Indices   corners   = cornersOf(triangles);
	const Real      tolerance = std::max(Real(construction::coincidence * set.size),
	             std::min(Real(coplanar * set.extent), Real(construction::thinnestFacets * halfWidth)));
	const auto      misfit    = [&set](const Indices& members) { return planeFit(set.points, members).misfit; };
	const auto      outside   = [&](const Indices& members) {
                const Fit fit   = outwardFit(set.points, members, inner);
                Real      reach = 0;
                for (int i : corners)
                        reach = std::max(reach, Real(fit.normal.dot(set.points[std::size_t(i)] - fit.middle)));
                return reach;
	};
	const auto apart = [&](int left, int right) {
		return missEachOther(set.points, cornersOfTwo(triangles[std::size_t(left)], triangles[std::size_t(right)]), tolerance);
	};
	const Clusters facets = cluster(triangles, edges, apart, misfit, outside, tolerance);

	// in the order of their points: that of the triangles depends on how the hull cut the facets
	std::vector<Indices> ordered;
	for (std::size_t t = 0; t < triangles.size(); ++t)
		if (facets.of[t] == int(t)) ordered.push_back(facets.members[t]);
	std::sort(ordered.begin(), ordered.end());

	HalfSpaces planes;
	planes.dimension = dimension;
	for (const Indices& members : ordered) {
		const Fit fit = outwardFit(set.points, members, inner);
		if (fit.width > tolerance) addPlane(planes, set, members, fit); // else it is an edge, and its neighbours bound it
	}
	return planes;
}

} // namespace polytope
