// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ShapeFactory.hpp"

#include "shape/ConstructionTolerances.hpp"
#include "shape/KnownShapes.hpp"
#include "shape/RoundedSolid.hpp"

#include <limits>
#include <utility>

namespace polytope {
namespace {

	struct KnownCentral {
		std::weak_ptr<const ConvexShape> shape;
		Vector3                          position;
		Matrix3                          rotation;
	};

	using Known = KnownShapes<KnownCentral>;

	/// Numbers of an input that is remembered. Reading a mesh of more than a thousand points takes longer than making its hull, and a
	/// key of its size would be stored as long as the body exists.
	constexpr std::size_t longestKey = 4096;

	/// The numbers that make the shape.
	Known::Key keyOf(
	        int kind, const std::vector<Vector3>& vectors, const std::vector<Real>& numbers, int dimension, const ShapeOptions& options)
	{
		Known::Key key { Real(kind), Real(dimension), options.thickness, Real(options.keepRedundant),
			Real(options.cornerRadius ? 1 : 0), options.cornerRadius ? *options.cornerRadius : options.cornerFraction,
			options.margin };
		key.reserve(key.size() + 3 * vectors.size() + numbers.size());
		for (const Vector3& v : vectors)
			key.insert(key.end(), { v[0], v[1], v[2] });
		key.insert(key.end(), numbers.begin(), numbers.end());
		return key;
	}

	/// What is known by this key, or what `make` makes.
	template <class Make> CentralShape knownOr(Known::Key key, const Make& make)
	{
		if (key.size() > longestKey) return make();
		static Known known;
		CentralShape result;
		KnownCentral found;
		if (known.find(key, found, result.shape)) {
			result.position = found.position;
			result.rotation = found.rotation;
			return result;
		}
		result       = make();
		result.shape = known.keep(std::move(key), { result.shape, result.position, result.rotation }, result.shape);
		return result;
	}

	/// The set without the planes that own no face.
	HalfSpaces facesOnly(const HalfSpaces& set, Polyhedron& shape)
	{
		HalfSpaces kept;
		kept.dimension = set.dimension;
		for (int& plane : shape.planeOfFace) {
			if (plane < 0) continue;
			kept.normals.push_back(set.normals[std::size_t(plane)]);
			kept.offsets.push_back(set.offsets[std::size_t(plane)]);
			plane = int(kept.size()) - 1;
		}
		return kept;
	}

	Real extentOf(const Polyhedron& shape)
	{
		Real square = 0;
		for (const Vector3& vertex : shape.vertices)
			square = std::max(square, Real(vertex.squaredNorm()));
		return sqrt(square);
	}

	/// Planes, vertices and faces go to the frame of centroid and principal axes. All of it is computed from the numbers about the
	/// inner point: only these are accurate for a small body far from the origin.
	CentralShape made(const HalfSpaces& given, const ShapeOptions& options)
	{
		HalfSpaces      set   = withoutDuplicates(normalised(given));
		LocalPolyhedron local = localPolyhedron(set, options.thickness);
		if (!options.keepRedundant) set = facesOnly(set, local.shape);
		const MassProperties mass   = roundedMass(local.shape, options.margin / local.unit);
		const Real           extent = extentOf(local.shape);
		CentralShape         result;

		result.position = local.centre + local.unit * mass.centroid;
		if (set.dimension == 2) result.position.z() = 0;
		const bool central = result.position.norm() <= construction::centred * local.unit * extent;
		if (central) result.position.setZero();
		// about the rounded position, unless, far from the origin, that is not accurate enough as the centroid
		Vector3 centroid = (result.position - local.centre) / local.unit;
		if ((centroid - mass.centroid).norm() > construction::wellCentred * extent) centroid = mass.centroid;
		if (set.dimension == 2) centroid.z() = 0;
		if (!central)
			for (std::size_t i = 0; i < set.size(); ++i)
				set.offsets[i]
				        = (set.offsets[i] - set.normals[i].dot(local.centre)) - local.unit * set.normals[i].dot(centroid);

		result.rotation = principalAxes(mass.inertia, set.dimension).rotation;
		if (result.rotation != Matrix3::Identity())
			for (Vector3& normal : set.normals)
				normal = (result.rotation.transpose() * normal).eval();
		for (Vector3& vertex : local.shape.vertices)
			vertex = result.rotation.transpose() * Vector3(local.unit * (vertex - centroid));
		result.shape = ConvexShape::ofFaces(
		        set, std::move(local.shape), options.cornerRadius, options.cornerFraction, options.thickness);
		return result;
	}

} // namespace

CentralShape centralShape(const HalfSpaces& planes, const ShapeOptions& options)
{
	return knownOr(keyOf(0, planes.normals, planes.offsets, planes.dimension, options), [&] { return made(planes, options); });
}

CentralShape centralHull(const std::vector<Vector3>& points, int dimension, const Real& coplanar, const ShapeOptions& options)
{
	return knownOr(
	        keyOf(1, points, { coplanar }, dimension, options), [&] { return made(hullOf(points, dimension, coplanar), options); });
}

} // namespace polytope
