// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "loads/VelocityHistory.hpp"

#include <core/PartialEngine.hpp>

namespace yade {

class QuietBoundary : public PartialEngine {
public:
	virtual ~QuietBoundary() = default;

	/// Refuses with std::invalid_argument lists of different lengths.
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(QuietBoundary, PartialEngine,
	R"""(Quiet boundary [Lysmer1969]_: dashpots on the outer faces of bodies that let waves out of the model, as if it went on there.
*polytope.quietBoundary(…)* makes it and computes the lists, each with a value for each of :yref:`ids<PartialEngine.ids>`. The force on a face of area
$A$, at its centroid, is $A\rho c_p$ times the normal part of $2v_i-v$ plus $A\rho c_s$ times its tangential part, with the velocity $v$ of the face
and that of a wave that comes in there, $v_i$ (:yref:`history<QuietBoundary.history>`); to this comes the force that held the body at rest
(:yref:`supports<QuietBoundary.supports>`).)""",
		((Vector3r, normal, Vector3r(0, 0, -1), , "Outward normal of the boundary, of length 1."))
		((vector<Real>, normalDashpots, , , "$A\\rho c_p$ [N·s/m]."))
		((vector<Real>, shearDashpots, , , "$A\\rho c_s$ [N·s/m]."))
		((vector<Vector3r>, faces, , , "Centroid of the outer faces in the body's axes, from its centre [m]."))
		((vector<Vector3r>, supports, , , "Force that held the body at rest [N], at the body's centre."))
		((shared_ptr<VelocityHistory>, history, , , "Velocity $v_i$ of the wave that comes in: half of that of a free surface of the same "
		        "rock. None: no wave."))
	);
	// clang-format on

private:
	void refuseWhatCannotBe();

	vector<Vector3r> forces_, arms_; ///< of this step
};
REGISTER_SERIALIZABLE(QuietBoundary);

} // namespace yade
