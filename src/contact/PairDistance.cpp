// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PairDistance.hpp"

#include "numbers/Tolerances.hpp"
#include "shape/DistanceTolerances.hpp"

#include <Eigen/QR>

#include <algorithm>

namespace polytope {

namespace {

	/// A body where it is, by its vertices.
	class Placed {
	public:
		Placed(const ConvexShape& shape, const Matrix3& rotation, const Vector3& centre)
		        : shape_(shape), rotation_(rotation), centre_(centre)
		{
			if (shape.dimension() == 3) return;
			flatten(centre_);
			rotation_.row(2).setZero();
		}

		/// The vertex farthest along a direction of the world.
		Vector3 support(const Vector3& direction) const
		{
			return centre_ + rotation_ * shape_.support(rotation_.transpose() * direction);
		}

		const Matrix3& rotation() const { return rotation_; }
		const Vector3& centre() const { return centre_; }

	private:
		const ConvexShape& shape_;
		Matrix3            rotation_;
		Vector3            centre_;

		static void flatten(Vector3& v) { v[2] = 0; }
	};

	/// The convex hull of points.
	class Hull {
	public:
		explicit Hull(const std::vector<Vector3>& points) : points_(points) { }

		const Vector3& support(const Vector3& direction) const
		{
			return *std::max_element(points_.begin(), points_.end(),
			        [&](const Vector3& a, const Vector3& b) { return direction.dot(a) < direction.dot(b); });
		}
		const Vector3& middle() const { return points_.front(); }
		Real           reach() const
		{
			Real farthest = 0;
			for (const Vector3& point : points_)
				farthest = std::max(farthest, Real((point - middle()).norm()));
			return farthest;
		}

	private:
		const std::vector<Vector3>& points_;
	};

	/// Vertices of the difference of both bodies, affinely independent, with the weights of the point that is nearest to the origin.
	class Corral {
	public:
		Corral(const Vector3& one, const Vector3& other) { add(one, other); }

		int size() const { return size_; }
		/// It is normal to the line or plane through the vertices. Rounding of their sum, which is of their size and not of the distance, does
		/// not turn it.
		Vector3 nearest() const
		{
			Vector3 point = sum([&](int k) { return difference(k); });
			Vector3 axes[3];
			for (int k = 1; k < size_; ++k) {
				const Vector3 edge = difference(k) - difference(0);
				Vector3&      axis = axes[k - 1];
				axis               = edge;
				for (int twice = 0; twice < 2; ++twice)
					for (int j = 0; j + 1 < k; ++j)
						axis -= axes[j].dot(axis) * axes[j];
				const Real length = axis.norm(), least = Real(tolerance::edgeOfOthers) * edge.norm();
				axis = length > least ? Vector3(axis / length) : Vector3(Vector3::Zero());
				point -= axis.dot(point) * axis;
			}
			return point;
		}
		Vector3 point(int body) const
		{
			return sum([&](int k) { return vertex_[body][k]; });
		}

		bool has(const Vector3& one, const Vector3& other) const
		{
			for (int k = 0; k < size_; ++k)
				if (vertex_[0][k] == one && vertex_[1][k] == other) return true;
			return false;
		}

		void add(const Vector3& one, const Vector3& other)
		{
			vertex_[0][size_] = one;
			vertex_[1][size_] = other;
			weight_[size_]    = size_ == 0 ? 1 : 0;
			++size_;
		}

		/// To the point of their hull that is nearest to the origin; vertices that are not needed for it leave.
		void settle()
		{
			for (;;) {
				Real weight[4];
				ofPlane(weight);
				Real along   = 1;
				int  leaving = -1;
				for (int k = 0; k < size_; ++k) {
					if (weight[k] > 0) continue;
					const Real until = weight_[k] / (weight_[k] - weight[k]);
					if (leaving >= 0 && !(until < along)) continue;
					along   = std::min(Real(1), std::max(Real(0), until));
					leaving = k;
				}
				for (int k = 0; k < size_; ++k)
					weight_[k] += along * (weight[k] - weight_[k]);
				if (leaving < 0) return;
				remove(leaving);
			}
		}

	private:
		Vector3 vertex_[2][4];
		Real    weight_[4];
		int     size_ = 0;

		Vector3 difference(int k) const { return vertex_[0][k] - vertex_[1][k]; }

		template <class Value> Vector3 sum(const Value& value) const
		{
			Vector3 all = Vector3::Zero();
			for (int k = 0; k < size_; ++k)
				all += weight_[k] * value(k);
			return all;
		}

		/// Weights of the vertices in the nearest point of the line, plane or space through all of them.
		void ofPlane(Real* weight) const
		{
			using Edges = Eigen::Matrix<Real, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
			weight[0]   = 1;
			if (size_ == 1) return;
			Edges edges(3, size_ - 1);
			for (int k = 1; k < size_; ++k)
				edges.col(k - 1) = difference(k) - difference(0);
			const Eigen::Matrix<Real, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1> rest
			        = Eigen::ColPivHouseholderQR<Edges>(edges).solve(-difference(0));
			for (int k = 1; k < size_; ++k) {
				weight[k] = rest[k - 1];
				weight[0] -= weight[k];
			}
		}

		void remove(int leaving)
		{
			--size_;
			for (auto& vertex : vertex_)
				vertex[leaving] = vertex[size_];
			weight_[leaving] = weight_[size_];
		}
	};

	PairDistance apart(const Vector3& one, const Vector3& other, Real distance, const Vector3& normal)
	{
		PairDistance result;
		result.distance = distance;
		result.normal   = normal;
		result.point[0] = one;
		result.point[1] = other;
		return result;
	}

	/// Distance of a half-space and a body; `sign`: 1 where the half-space is body 1.
	PairDistance fromWall(const ConvexShape& wall, const Placed& place, const Placed& body, int sign)
	{
		const Vector3 normal   = place.rotation() * wall.planes().normals.front();
		const Vector3 nearest  = body.support(-normal);
		const Real    distance = normal.dot(nearest - place.centre()) - wall.planes().offsets.front();
		const Vector3 foot     = nearest - distance * normal;
		if (!(distance > 0)) return {};
		return sign > 0 ? apart(foot, nearest, distance, normal) : apart(nearest, foot, distance, -normal);
	}

	/// \param way from a point of body 1 to one of body 2; `reach`: as far as any two of their points may be apart
	template <class Body>
	PairDistance ofVertices(const Body& body1, const Body& body2, const Vector3& way, const Real& reach, int vertices)
	{
		const Real least = Real(tolerance::distance) * reach;
		Corral     corral(body1.support(way), body2.support(-way));
		const int  most    = tolerance::distanceStepsAtLeast + tolerance::distanceSteps * vertices;
		Vector3    nearest = corral.nearest();
		for (int step = 0; step < most; ++step) {
			const Real distance = nearest.norm();
			if (!(distance > least)) return {};
			const Vector3 one = body1.support(-nearest), other = body2.support(nearest);
			const Real    gain = nearest.dot(nearest - (one - other)) / distance;
			if (!(gain > least / 4) || corral.size() == 4 || corral.has(one, other)) break;
			corral.add(one, other);
			corral.settle();
			const Vector3 next = corral.nearest();
			if (!(next.squaredNorm() < nearest.squaredNorm())) break; // rounding
			nearest = next;
		}
		nearest             = corral.nearest();
		const Real distance = nearest.norm();
		if (!(distance > least)) return {};
		return apart(corral.point(0), corral.point(1), distance, -nearest / distance);
	}

} // namespace

PairDistance pairDistance(const PlacedPair& pair)
{
	const ConvexShape &shape1 = *pair.shape[0], &shape2 = *pair.shape[1];
	const Placed       body1(shape1, *pair.rotation[0], Vector3::Zero()), body2(shape2, *pair.rotation[1], *pair.centre2);
	const auto &       vertices1 = shape1.polyhedron().vertices, &vertices2 = shape2.polyhedron().vertices;
	if (vertices1.empty()) return vertices2.empty() ? PairDistance() : fromWall(shape1, body1, body2, 1);
	if (vertices2.empty()) return fromWall(shape2, body2, body1, -1);

	const Real reach = shape1.boundingRadius() + shape2.boundingRadius() + body2.centre().norm();
	return ofVertices(body1, body2, body2.centre(), reach, int(vertices1.size() + vertices2.size()));
}

PairDistance pairDistance(const std::vector<Vector3>& points1, const std::vector<Vector3>& points2)
{
	if (points1.empty() || points2.empty()) return {};
	const Hull    body1(points1), body2(points2);
	const Vector3 way = body2.middle() - body1.middle();
	return ofVertices(body1, body2, way, body1.reach() + body2.reach() + way.norm(), int(points1.size() + points2.size()));
}

} // namespace polytope
