// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"

namespace polytope::samples {

/// What a law of stiffness one makes of the contact of a model with a surface: the force on body 2, its moment about a point (world axes from body 1's centre)
/// with the part about the normal, and the energy.
struct ContactLoad {
	Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
	Real    energy = 0;

	ContactLoad() = default;
	ContactLoad(const ContactResult& result, ContactModel model, const ClosureLaw& law = ClosureLaw(),
	        const Vector3& about = Vector3::Zero())
	{
		const Real stiffness = model == ContactModel::Foundation ? result.area : Real(1);
		force                = stiffness * law.pressure(result.depth) * result.normal;
		moment               = Vector3(result.point - about).cross(force) + result.turningArm * force;
		energy               = stiffness * result.energy * law.tangent(result.depth);
	}
};

} // namespace polytope::samples
