// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/serialization/Serializable.hpp>

namespace yade {

/// A velocity over time, linear between given instants.
class VelocityHistory : public Serializable {
public:
	virtual ~VelocityHistory() = default;

	/// Refuses with std::invalid_argument what is no history, naming the attribute.
	void postLoad(VelocityHistory&);

	/// Zero before the first instant, the last velocity after the last one.
	Vector3r at(const Real& time) const;
	/// Whether the velocity may change at this time.
	bool goesOn(const Real& time) const { return time >= times.front() && time <= times.back(); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(VelocityHistory, Serializable,
	R"""(A velocity over time, for :yref:`BaseMotion` and :yref:`QuietBoundary`; *polytope.velocityHistory(…)* makes it from a record. Linear
between the given instants, zero before the first one; after the last one the last velocity goes on.)""",
		((vector<Real>, times, , Attr::readonly, "Instants of the simulation (O.time) [s], increasing."))
		((vector<Vector3r>, velocities, , Attr::readonly, "Velocity at each of them [m/s]."))
		, /*ctor*/
		, /*py*/
		.def("at", &VelocityHistory::at, (boost::python::arg("time")), "Velocity [m/s] at a time of the simulation [s].")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(VelocityHistory);

} // namespace yade
