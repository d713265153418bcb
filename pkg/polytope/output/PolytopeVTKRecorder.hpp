// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#ifdef YADE_VTK

#include <pkg/common/PeriodicEngines.hpp>

#include "host/CheckedAttributes.hpp"

namespace yade {

class PolytopeVTKRecorder : public PeriodicEngine {
public:
	/// Writes the snapshot of this step, and the series' list anew.
	void action() override;
	/// Refuses unknown recorders, and restores the last good list.
	void postLoad(PolytopeVTKRecorder&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(PolytopeVTKRecorder, PeriodicEngine,
	R"""(Records :yref:`Polytopes<Polytope>` and their contacts for ParaView and other programs that read VTK's files (bodies of other shapes:
:yref:`VTKRecorder`). Every snapshot is a file per recorder, and a list of all snapshots with their times (``.pvd``, open this one in ParaView) is
kept up to date:

``bodies``
	``<fileName>bodies.<step>.vtu``: a polyhedral cell for each body (polygons as prisms of their :yref:`thickness<Polytope.thickness>`), with
	*id*, *color* (three bytes: uncheck “map scalars” to see it), *mask*, *materialId*, *dynamic*, *mass*, *velocity*, *angularVelocity* and
	*displacement* (from :yref:`State.refPos`).
``contacts``
	``<fileName>contacts.<step>.vtp``: a point for each real interaction of a polytope or of two bodies of YADE's own (each whose geometry is a
	:yref:`ScGeom`: spheres with each other and on facets, boxes and walls), with *id1*, *id2*, *normal* (from body 1 to 2), *normalForce* and
	*shearForce* (on body 2), *depth*, *area* and *infeasibility* (0 where they were not computed, and between bodies of YADE's own) and
	*status* (a number; the file's field data *statusNames* has the names in this order). Show them with a Glyph filter.
``bonds`` (where it is among the :yref:`recorders<PolytopeVTKRecorder.recorders>`)
	``<fileName>bonds.<step>.vtp``: the area of each bond of :yref:`PolytopeBonds` as a polygon, with *id1*, *id2*, *state* (0 intact, 1 failed
	in tension, 2 in shear; names in the field data *stateNames*), *force* and *moment* (on body 2), *normalStress*, *edgeStress*, *shearStress*
	and *energy* as in :yref:`PolytopeBond`, 0 where it has failed. A failed bond stays on the first body; bonds of erased bodies are left out.
``bolts`` (where it is among the :yref:`recorders<PolytopeVTKRecorder.recorders>`)
	``<fileName>bolts.<step>.vtp``: each element of steel of each bolt of :yref:`PolytopeBolts` as a line, with *bolt* (its number), *force*
	(tension), *strain*, *broken* (0 or 1), *shearForce* (of the dowel, on the block farther from the head) and *radius* (for a Tube filter).
	Elements at an erased block are left out.

In a periodic scene, bodies and contact points are moved into the cell. Called as a function, ``recorder()`` writes a snapshot at once.
:yref:`PeriodicEngine.initRun` is ``True`` here.)""",
		((string, fileName, "", , "Beginning of all file names; may contain folders, which are created where they are missing."))
		((vector<string>, recorders, vector<string>({ "bodies", "contacts" }), Attr::triggerPostLoad,
		        "What to record: *bodies*, *contacts*, *bonds*, *bolts*."))
		((int, mask, 0, , "Record bodies compatible with this :yref:`mask<Body.mask>` only, and contacts, bonds and bolts that have such a "
		        "body; 0: all."))
		((bool, skipNondynamic, false, , "Leave out bodies that cannot move (floors, walls); their contacts are kept."))
		((bool, compress, true, , "Compress the data."))
		((bool, ascii, false, , "Data as readable text."))
		((vector<int>, steps, , (Attr::readonly), "Steps recorded so far: the series. Steps not before the present one are dropped when a "
		        "snapshot is written, so that a simulation begun again starts its series again."))
		((vector<Real>, times, , (Attr::readonly), "Times of these steps [s]."))
		, /*ctor*/ initRun = true;
	);
	// clang-format on
	DECLARE_LOGGER;

private:
	bool                              has(const string& recorder) const;
	bool                              recorded(const Body& body) const;
	void                              writeBodies(const string& file) const;
	void                              writeContacts(const string& file) const;
	void                              writeBonds(const string& file) const;
	void                              writeBolts(const string& file) const;
	void                              writeSeries(const string& recorder, const string& extension) const;
	string                            snapshotName(const string& recorder, long step, const string& extension) const;
	CheckedAttributes<vector<string>> checked_ { std::tie(recorders) };
};
REGISTER_SERIALIZABLE(PolytopeVTKRecorder);

} // namespace yade

#endif // YADE_VTK
