// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond/CommonFace.hpp"

#include "bond/BondTolerances.hpp"
#include "shape/Rings.hpp"
#include "shear/ContactOutline.hpp"

#include <algorithm>

namespace polytope {
namespace {

	using std::atan2;
	using std::cos;
	using std::sin;
	using Ring = std::vector<Vector2>;

	/// One face of a body as it stands.
	struct Face {
		Vector3          normal;
		Real             offset; ///< normal·x = offset, from the origin that both bodies share
		const Vector3*   corners;
		std::vector<int> ring;
	};

	std::vector<Face> facesOf(const PlacedShape& body, const Vector3& origin)
	{
		const Polyhedron& solid = body.shape.polyhedron();
		std::vector<Face> faces;
		for (std::size_t i = 0; i < solid.faces.size(); ++i) {
			const int plane = solid.planeOfFace[i];
			if (plane < 0) continue; // a polygon's caps
			const Vector3 normal = body.rotation * body.shape.planes().normals[plane];
			faces.push_back({ normal, body.shape.planes().offsets[plane] + normal.dot(body.centre - origin),
			        solid.vertices.data(), solid.faces[i] });
		}
		return faces;
	}

	/// Corners of a face seen along u × v.
	Ring seen(const Face& face, const PlacedShape& body, const Vector3& origin, const Vector3& u, const Vector3& v)
	{
		Ring ring;
		for (int corner : face.ring) {
			const Vector3 x = body.rotation * face.corners[corner] + (body.centre - origin);
			ring.emplace_back(u.dot(x), v.dot(x));
		}
		return ring;
	}

	/// What of a convex ring lies left of the line from `from` to `to`.
	Ring leftOf(const Ring& ring, const Vector2& from, const Vector2& to)
	{
		Ring kept;
		keepAbove(ring, [&](const Vector2& x) { return cross(to - from, x - from); }, kept);
		return kept;
	}

	OutlineMoments momentsOf(const Ring& ring) { return polytope::momentsOf(ring.data(), int(ring.size())); }

	/// Turns u, v and the ring to the principal axes of the ring's area.
	void turnToPrincipalAxes(CommonFace& face, Ring& ring, Vector3& u, Vector3& v)
	{
		OutlineMoments now      = momentsOf(ring);
		const Real(&moments)[3] = now.second;
		// of a square or circle all axes are principal: as they are
		const Real difference = moments[0] - moments[2], mixed = 2 * moments[1], size = moments[0] + moments[2];
		if (abs(mixed) > tolerance::isotropicArea * size || abs(difference) > tolerance::isotropicArea * size) {
			const Real    angle = atan2(mixed, difference) / 2, c = cos(angle), s = sin(angle);
			const Vector3 other = c * v - s * u;
			u                   = c * u + s * v;
			v                   = other;
			for (Vector2& x : ring)
				x = Vector2(c * x[0] + s * x[1], c * x[1] - s * x[0]);
			now = momentsOf(ring);
		}
		face.second = { moments[0], moments[2] };
	}

} // namespace

Real touchingGap(const ConvexShape& first, const ConvexShape& second)
{
	return tolerance::touchingFaces * std::min(first.boundingRadius(), second.boundingRadius());
}

Real deepestOverlap(const ConvexShape& first, const ConvexShape& second)
{
	return tolerance::deepestOfFaces * std::min(first.inscribedRadius(), second.inscribedRadius());
}

std::vector<CommonFace> commonFaces(const PlacedShape& first, const PlacedShape& second, const Real& gap, const Real& angle)
{
	const Vector3           origin = first.centre; // small numbers wherever the bodies are
	const auto              faces1 = facesOf(first, origin), faces2 = facesOf(second, origin);
	const Real              opposite = cos(angle), deepest = deepestOverlap(first.shape, second.shape);
	std::vector<CommonFace> found;
	for (const Face& face1 : faces1)
		for (const Face& face2 : faces2) {
			if (face1.normal.dot(face2.normal) > -opposite) continue;
			CommonFace    common;
			const Vector3 normal = (face1.normal - face2.normal).normalized();
			Vector3       u = normal.unitOrthogonal(), v = normal.cross(u);
			Ring          ring = seen(face1, first, origin, u, v);
			Ring          clip = seen(face2, second, origin, u, v);
			std::reverse(clip.begin(), clip.end());
			const Real smaller = std::min(momentsOf(ring).area, momentsOf(clip).area);
			for (std::size_t k = 0; k < clip.size() && ring.size() > 2; ++k)
				ring = leftOf(ring, clip[k], clip[(k + 1) % clip.size()]);
			const OutlineMoments moments = momentsOf(ring);
			common.area                  = moments.area;
			if (!(common.area > tolerance::leastBondArea * smaller)) continue;

			const Vector2 middle = moments.centroid;
			const Vector3 point  = middle[0] * u + middle[1] * v; // to both faces along the normal
			const Real    to1    = (face1.offset - face1.normal.dot(point)) / face1.normal.dot(normal),
			           to2       = (face2.offset - face2.normal.dot(point)) / face2.normal.dot(normal);
			common.gap           = to2 - to1;
			if (!(common.gap <= gap && -common.gap <= deepest)) continue;
			common.centroid = origin + point + (to1 + to2) / 2 * normal;
			for (Vector2& x : ring)
				x -= middle;
			turnToPrincipalAxes(common, ring, u, v);
			common.axes << normal, u, v;
			common.normal1 = face1.normal;
			common.normal2 = face2.normal;
			common.corners = std::move(ring);
			found.push_back(std::move(common));
		}
	return found;
}

const CommonFace* largestAlong(const std::vector<CommonFace>& faces, const Vector3& direction, const Real& cosine)
{
	const CommonFace* largest = nullptr;
	for (const CommonFace& face : faces)
		if (face.axes.col(0).dot(direction) > cosine && (!largest || face.area > largest->area)) largest = &face;
	return largest;
}

} // namespace polytope
