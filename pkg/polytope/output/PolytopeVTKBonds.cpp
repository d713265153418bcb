// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef YADE_VTK

#include "bonding/PolytopeBonds.hpp"
#include "output/PolytopeVTKRecorder.hpp"
#include "output/VtkFiles.hpp"

#include <core/Scene.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace yade {

using namespace vtkFiles;

/// The area of each bond as a polygon, where the first body has carried it; bonds of erased bodies have no place any more.
void PolytopeVTKRecorder::writeBonds(const string& file) const
{
	vtkNew<vtkPolyData>  data;
	vtkNew<vtkPoints>    points;
	vtkNew<vtkCellArray> areas;
	points->SetDataTypeToDouble();
	vtkCellData* const cells = data->GetCellData();
	auto *const id1 = column<vtkIntArray>(cells, "id1"), *const id2 = column<vtkIntArray>(cells, "id2");
	auto* const state = column<vtkIntArray>(cells, "state");
	auto *const force = column<vtkDoubleArray>(cells, "force", 3), *const moment = column<vtkDoubleArray>(cells, "moment", 3);
	auto *const normal = column<vtkDoubleArray>(cells, "normalStress"), *const edge = column<vtkDoubleArray>(cells, "edgeStress");
	auto *const shear = column<vtkDoubleArray>(cells, "shearStress"), *const energy = column<vtkDoubleArray>(cells, "energy");
	const std::vector<string> states { "intact", "tension", "shear" };

	for (const auto& engine : scene->engines) {
		const auto* const those = dynamic_cast<const PolytopeBonds*>(engine.get());
		if (!those) continue;
		for (const auto& bond : those->bonds) {
			const auto body1 = Body::byId(bond->id1, scene), body2 = Body::byId(bond->id2, scene);
			if (!body1 || !body2 || !(recorded(*body1) || recorded(*body2)) || bond->failure == "erased") continue;
			const State&      at    = *body1->state;
			const Vector3r    shift = insideCell(*scene, at.pos) - at.pos;
			const vtkIdType   first = points->GetNumberOfPoints();
			const Quaternionr turn  = at.ori * bond->frame1;
			areas->InsertNextCell(int(bond->corners.size()));
			for (std::size_t k = 0; k < bond->corners.size(); ++k) {
				append(points, at.pos + shift + at.ori * bond->point1 + turn * bond->corners[k]);
				areas->InsertCellPoint(first + vtkIdType(k));
			}
			id1->InsertNextValue(bond->id1);
			id2->InsertNextValue(bond->id2);
			state->InsertNextValue(bond->intact ? 0 : bond->failure == states[1] ? 1 : 2);
			append(force, bond->intact ? bond->force : Vector3r::Zero());
			append(moment, bond->intact ? bond->moment : Vector3r::Zero());
			normal->InsertNextValue(bond->intact ? double(bond->normalStress) : 0);
			edge->InsertNextValue(bond->intact ? double(bond->edgeStress) : 0);
			shear->InsertNextValue(bond->intact ? double(bond->shearStress) : 0);
			energy->InsertNextValue(bond->intact ? double(bond->energy) : 0);
		}
	}
	data->SetPoints(points);
	data->SetPolys(areas);
	stampTime(data, *scene);
	auto* const names = column<vtkStringArray>(data->GetFieldData(), "stateNames");
	for (const string& name : states)
		names->InsertNextValue(name);
	writeFile<vtkXMLPolyDataWriter>(data, file, ascii, compress);
}

} // namespace yade

#endif // YADE_VTK
