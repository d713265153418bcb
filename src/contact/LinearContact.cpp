// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/LinearContact.hpp"

#include "numbers/PlaneAxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polytope {

bool LinearContact::follow(const PlacedPair& pair, const ContactOptions& options, const Vector3& point1, const Vector3& point2,
        ContactResult& result, OutlineMotion& outline)
{
	using std::abs;
	if (!known || perArea != (options.contactModel == ContactModel::Foundation) || (options.energy && energy < 0)) return false;
	if (sizes[0] != sizeOf(*pair.shape[0]) || sizes[1] != sizeOf(*pair.shape[1])) return false;
	const Matrix3 &one = *pair.rotation[exchanged], &two = *pair.rotation[!exchanged];
	const Vector3 &own = exchanged ? point2 : point1, &other = exchanged ? point1 : point2;
	const Vector3  centre = exchanged ? Vector3(-*pair.centre2) : *pair.centre2;

	// motion of the second body in the first's axes, at the contact point of the last full computation
	const Vector3 arm = one * own, gap = two * other + centre - arm, moved = one.transpose() * gap;
	Vector3       column[3]; // of the second body's rotation in the first's axes
	for (int k = 0; k < 3; ++k)
		column[k] = one.transpose() * two.col(k);
	// the antisymmetric part of (rotation now) (rotation then)ᵀ
	const auto entry = [&](int i, int j) {
		const Real* const then = pose.data() + 3 * j;
		return column[0][i] * then[0] + column[1][i] * then[1] + column[2][i] * then[2];
	};
	const Vector3 turn((entry(2, 1) - entry(1, 2)) / 2, (entry(0, 2) - entry(2, 0)) / 2, (entry(1, 0) - entry(0, 1)) / 2);
	const Real    far = radius * turn.norm();
	if (!(moved.norm() + far <= along)) return false;

	Real motion[6], now[6], work = 0;
	for (int k = 0; k < 3; ++k) {
		motion[k]     = moved[k];
		motion[3 + k] = radius * turn[k];
	}
	Real change[6] = {};
	for (int j = 0; j < 6; ++j)
		for (int i = 0; i < 6; ++i)
			change[i] += Real(slope[std::size_t(6 * j + i)]) * motion[j];
	for (int i = 0; i < 6; ++i) {
		change[i] *= unit;
		now[i] = load[std::size_t(i)] + change[i];
		work += (load[std::size_t(i)] + change[i] / 2) * motion[i];
	}
	// the moment is about where the contact point was: there the second body moves by −θ × u less, on the way half of it
	work -= Vector3(load[0], load[1], load[2]).dot(turn.cross(moved)) / 2;
	const Vector3 force(now[0], now[1], now[2]), moment(radius * now[3], radius * now[4], radius * now[5]);
	const Real    length = force.norm();
	if (!(length > 0)) return false;
	const Vector3 normal = force / length, left = moment / length;
	if (!(abs(moved.dot(normal)) + far <= across)) return false;

	const Vector3 offset = normal.cross(left), away = one * offset;
	result.status = ContactStatus::Contact;
	result.linear = result.inContact = result.hasGeometry = result.surfaceKept = true;
	result.normal                                                              = one * normal;
	result.point                                                               = arm + away;
	result.turningArm                                                          = left.dot(normal);
	result.area                                                                = area;
	result.depth                                                               = perArea ? Real(length / area) : length;
	result.energy = energy < 0 ? Real(-1) : Real((energy - work) / (perArea ? area : Real(1)));
	if (exchanged) {
		result.normal = -result.normal;
		result.point += *pair.centre2;
	}

	const Matrix3&  body = *pair.rotation[carrier];
	const PlaneAxes axes(result.normal);
	const Vector3   u = body.transpose() * axes.u, v = body.transpose() * axes.v,
	              present = carrier == exchanged ? offset : Vector3(body.transpose() * (away - gap));
	outline.cosine        = axis.dot(u);
	outline.sine          = axis.dot(v);
	outline.shift         = Vector2((place - present).dot(u), (place - present).dot(v));
	axis                  = u;
	place                 = present;
	return true;
}

void LinearContact::keep(const Matrix3& first, const Matrix3& second, const std::array<Real, 6>& present, const Real (&derivative)[6][6],
        const Real& depth, const Real& areaOfSurface, const Real& radiusOfSurface, const Real& width)
{
	using std::abs;
	unit = 0;
	for (const Real(&row)[6] : derivative)
		for (const Real& one : row)
			if (!(abs(one) <= unit)) unit = abs(one);
	known = unit > 0 && unit <= std::numeric_limits<Real>::max();
	if (!known) return;
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 6; ++j)
			slope[std::size_t(6 * j + i)] = float(derivative[i][j] / unit);
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			pose[std::size_t(3 * i + j)] = first.col(i).dot(second.col(j));
	load   = present;
	area   = areaOfSurface;
	radius = radiusOfSurface;
	across = tolerance::linearAcross * depth;
	along  = std::max(across, Real(tolerance::linearAlong * width));
}

void LinearContact::begin(const PlacedPair& pair, bool exchangedBodies, const ContactResult& result)
{
	if (!known) return;
	exchanged = exchangedBodies;
	if (exchanged) carrier = !carrier;
	sizes = { { sizeOf(*pair.shape[0]), sizeOf(*pair.shape[1]) } };
	axis  = pair.rotation[carrier]->transpose() * PlaneAxes(result.normal).u;
	place = Vector3::Zero();
}

bool LinearContact::isSlow(
        int steps, const Real& depth, const Real& width, const Vector3& normal, const Vector3& motion, const Vector3& turn)
{
	using std::abs;
	const Real across = tolerance::linearAcross * depth, along = std::max(across, Real(tolerance::linearAlong * width)),
	           far = width * turn.norm();
	return steps * (abs(motion.dot(normal)) + far) <= across && steps * (motion.norm() + far) <= along;
}

} // namespace polytope
