// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/LinearByDifferences.hpp"

#include "contact/ContactQuery.hpp"

#include <algorithm>
#include <cmath>

namespace polytope {

namespace {

	using Load = Eigen::Matrix<Real, 6, 1>;

	/// Force on the second body and, over the radius, its moment about `x`, in the first body's axes; over the stiffness, which with *spring* has the
	/// `share` of the piece that it has now.
	Load loadOf(const ContactResult& result, bool perArea, const Vector3& x, const Real& radius, const Real& share, const Matrix3& axes)
	{
		const Vector3 force  = result.depth * (perArea ? result.area : Real(result.share / share)) * result.normal,
		              moment = (result.point - x).cross(force) + result.turningArm * force;
		Load load;
		load << axes.transpose() * force, axes.transpose() * moment / radius;
		return load;
	}

	/// How far the surface may reach from the contact point, about: of the body that lies on the pieces, whose tilt decides what each of them carries; where there
	/// are none, or both bodies are pieces, of the smaller one.
	Real radiusOf(const PlacedPair& pair, const InternalPlanes* internal)
	{
		const Real first = pair.shape[0]->boundingRadius(), second = pair.shape[1]->boundingRadius();
		if (internal && (internal->count[0] > 0) != (internal->count[1] > 0)) return internal->count[0] > 0 ? second : first;
		return std::min(first, second);
	}

	/// Of the surface, as its area over `radius`; of polygons, whose area is a length times a thickness, likewise.
	Real widthOf(const PlacedPair& pair, const Real& area, const Real& radius)
	{
		if (pair.shape[0]->dimension() == 3) return area / radius;
		const Real length = area / pair.thickness();
		return length * length / radius;
	}

	bool isSound(const ContactResult& result)
	{
		return result.status == ContactStatus::Contact && result.inContact && result.hasGeometry;
	}

} // namespace

void linearByDifferences(const PlacedPair& pair, const ContactSettings& settings, const PairMemory& memory, ContactWorkspace& workspace,
        const ContactResult& result, LinearContact& linear)
{
	linear.known = false;
	if (!isSound(result) || !(result.share >= Real(tolerance::leastShareOfSupport))) return;
	const bool      perArea = settings.contactModel == ContactModel::Foundation;
	const Matrix3 & one = *pair.rotation[0], &two = *pair.rotation[1];
	const Vector3&  x      = result.point;
	const Real      radius = radiusOf(pair, settings.internal);
	const Real      across = Real(tolerance::linearAcross) * -result.infeasibility;
	ContactSettings plain(settings);
	plain.section = true;
	plain.outline = false;
	plain.inside  = nullptr;
	plain.linear  = nullptr;

	const Load load        = loadOf(result, perArea, x, radius, result.share, one);
	Real       slope[6][6] = {};
	const Real leftOut     = Real(tolerance::linearLeftOut) * load.head<3>().norm() / result.share;
	const bool flat        = pair.shape[0]->dimension() == 2;
	for (int j = 0; j < 6; ++j) {
		if (flat && j >= 2 && j < 5) continue; // polygons move in their plane
		Load there[2];
		for (int side = 0; side < 2; ++side) {
			const Vector3 way     = (side == 0 ? across : Real(-across)) * one.col(j % 3);
			const Matrix3 turn    = j < 3 ? Matrix3(Matrix3::Identity())
			                              : Eigen::AngleAxis<Real>(way.norm() / radius, way.normalized()).toRotationMatrix();
			const Vector3 centre2 = j < 3 ? Vector3(*pair.centre2 + way) : Vector3(x + turn * (*pair.centre2 - x));
			const Matrix3 turned  = turn * two;
			PairMemory    started = memory;
			ContactResult found;
			contactQuery({ *pair.shape[0], one, *pair.shape[1], turned, centre2 }, plain, started, workspace, found);
			if (!isSound(found)) return;
			there[side] = loadOf(found, perArea, x, radius, result.share, one);
		}
		if (!(((there[0] + there[1]) / 2 - load).norm() <= leftOut)) return;
		for (int i = 0; i < 6; ++i)
			slope[i][j] = (there[0][i] - there[1][i]) / (2 * across);
	}

	std::array<Real, 6> present;
	std::copy(load.data(), load.data() + 6, present.begin());
	linear.keep(one, two, present, slope, -result.infeasibility, result.area, radius, widthOf(pair, result.area, radius));
	linear.energy  = -1; // a part has none of its own: only that of all pieces together has the force as its gradient
	linear.perArea = perArea;
	linear.carrier = pair.shape[1]->boundingRadius() < pair.shape[0]->boundingRadius();
	linear.begin(pair, false, result);
}

} // namespace polytope
