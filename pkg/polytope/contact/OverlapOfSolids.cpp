// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/OverlapOfSolids.hpp"

#include <src/contact/OverlapFaces.hpp>
#include <src/numbers/Tolerances.hpp>

#include <utility>

namespace yade {

namespace {

	Vector3r meanOf(const std::vector<Vector3r>& points)
	{
		Vector3r sum = Vector3r::Zero();
		for (const Vector3r& point : points)
			sum += point;
		return sum / Real(points.size());
	}

	OverlapOfSolids::Face faceOf(int body, std::size_t number, const std::vector<Vector3r>& corners, const Real& rounding)
	{
		OverlapOfSolids::Face face { body, number, corners, meanOf(corners), Vector3r::Zero(), false };
		Real                  length = 0;
		for (std::size_t k = 0; k < face.corners.size(); ++k) {
			const Vector3r arm = face.corners[k] - face.middle;
			face.area += arm.cross(face.corners[(k + 1) % face.corners.size()] - face.middle) / 2;
			length = math::max(length, arm.norm());
		}
		face.isThin = face.area.norm() <= Real(polytope::tolerance::thinFace) * rounding * length;
		return face;
	}

	/// Where very many planes meet in a point, one of them may have another face there, of rounding: what lies on it is the larger one.
	void dropRepeated(std::vector<OverlapOfSolids::Face>& faces)
	{
		for (OverlapOfSolids::Face& one : faces)
			for (OverlapOfSolids::Face& other : faces)
				if (&one != &other && one.body >= 0 && one.body == other.body && one.number == other.number)
					(one.area.squaredNorm() < other.area.squaredNorm() ? one : other).body = -1;
	}

} // namespace

OverlapOfSolids::OverlapOfSolids(const SolidOfPieces (&solids)[2], bool flat, const Real& reach)
{
	std::vector<polytope::Plane>             planes;
	std::vector<std::pair<int, std::size_t>> named; // body and number of each
	std::vector<polytope::Plane>             ofBody[2];
	const auto                               isThere = [&](int body, const polytope::Plane& plane) {
                return std::any_of(ofBody[1 - body].begin(), ofBody[1 - body].end(),
		                                      [&](const polytope::Plane& other) { return solids[body].isSame(other, plane, reach); });
	};
	const auto add = [&](int body, bool own) {
		const std::vector<FaceOfPiece>& faces = solids[body].faces;
		for (std::size_t k = 0; k < faces.size(); ++k) {
			if (faces[k].isInternal || (faces[k].own >= 0) != own || isThere(body, faces[k].plane)) continue;
			planes.push_back(faces[k].plane);
			ofBody[body].push_back(faces[k].plane);
			named.emplace_back(body, k);
		}
	};
	for (const bool own : { true, false })
		for (int body = 0; body < 2; ++body)
			if (solids[body].isPieced()) add(body, own);
	for (int body = 0; body < 2; ++body)
		if (!solids[body].isPieced()) add(body, true);
	for (int side = flat ? -1 : 2; side < 2; side += 2)
		planes.push_back({ Vector3r(0, 0, side), reach });
	for (polytope::OverlapFace& found : polytope::overlapFaces(planes, 2 * reach)) {
		const bool isNamed = found.plane >= 0 && std::size_t(found.plane) < named.size();
		const auto name    = isNamed ? named[std::size_t(found.plane)] : std::pair<int, std::size_t>(-1, 0);
		corners_.insert(corners_.end(), found.corners.begin(), found.corners.end());
		faces_.push_back(faceOf(name.first, name.second, found.corners, solids[0].rounding()));
	}
	dropRepeated(faces_);
}

Real OverlapOfSolids::widthFrom(const polytope::Plane& plane) const
{
	Real width = 0;
	for (const Vector3r& corner : corners_)
		width = math::max(width, Real(plane.offset - plane.normal.dot(corner)));
	return width;
}

/// Three times the volume over the surface, which is the radius of a ball of its circumscribed polyhedra.
Real OverlapOfSolids::thickness() const
{
	Real volume = 0, surface = 0;
	for (const Face& face : faces_) {
		volume += face.area.dot(face.middle) / 3;
		surface += face.area.norm();
	}
	return surface > 0 ? Real(3 * volume / surface) : Real(0);
}

Vector3r OverlapOfSolids::middle() const { return meanOf(corners_); }

} // namespace yade
