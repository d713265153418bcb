// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/PeriodicEngines.hpp>

namespace yade {

class PolytopeCheckpoint : public PeriodicEngine {
public:
	bool isActivated() override;
	/// In a step: saves the scene as it will be at the step's end.
	void action() override;
	/// Between steps: saves the scene as it is.
	void write();

	/// From now on the signals SIGTERM and SIGINT are noted for isActivated(), then go to the handler that was there.
	static void watchSignals();
	/// The signal that was noted and for which nothing has been saved yet; 0: none.
	static int notedSignal();
	/// This signal is sent once more when the step under way has been saved, and not noted then.
	static void postpone(int number);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeCheckpoint, PeriodicEngine,
	R"""(Saves the scene at every *iterPeriod* steps or *realPeriod* seconds, and keeps the last two states: ``<fileName>.yade`` and
``<fileName>.previous.yade``, which :yref:`O.load<Omega.load>` reads. A state is written to ``<fileName>.writing.yade``, made safe on the disk and
then renamed, so a process that is killed at any moment leaves complete states. *polytope.checkpoint* makes one that also saves when the process gets
SIGTERM or SIGINT, *polytope.continueFrom* loads the newest. Put it at the end of *O.engines*: engines after it would not run in the step that is
saved.)""",
		((string, fileName, "checkpoint", , "Beginning of the files' names; may contain folders, which are created where they are missing."))
		((bool, onSignal, false, , "Whether the run is saved and stopped at the end of the step in which SIGTERM or SIGINT comes; "
		        "*polytope.checkpoint* and *polytope.continueFrom* set up what it needs."))
		((int, written, 0, Attr::readonly, "Number of states saved, those of runs that this one continues included."))
		((vector<int>, loaded, , Attr::readonly, "Bodies with permanent forces or torques, which YADE does not save"))
		((vector<Vector3r>, permanentForces, , Attr::readonly, "Permanent forces of these bodies [N]"))
		((vector<Vector3r>, permanentTorques, , Attr::readonly, "Permanent torques of these bodies [N·m]"))
		, /*ctor*/
		, /*py*/
		.def("write", &PolytopeCheckpoint::write, "Save the scene now, between two steps.")
		.def("notedSignal", &PolytopeCheckpoint::notedSignal, "Number of the signal that came and for which nothing has been saved yet; 0: "
		        "none.").staticmethod("notedSignal")
		.def("postpone", &PolytopeCheckpoint::postpone, "Send this signal once more when the step under way has been saved; the handler "
		        "that polytope.checkpoint sets calls it.").staticmethod("postpone")
		.def("watchSignals", &PolytopeCheckpoint::watchSignals, "Note SIGTERM and SIGINT from now on, before the handlers there are; "
		        "polytope.checkpoint calls it.").staticmethod("watchSignals")
	);
	// clang-format on

private:
	string nameOf(const char* state) const;
	void   notePermanentLoads();
	/// Writes the scene as it is in memory; the last state becomes the previous one.
	void save();
};
REGISTER_SERIALIZABLE(PolytopeCheckpoint);

} // namespace yade
