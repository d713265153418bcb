// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef YADE_VTK

#include "bolt/PolytopeBolts.hpp"
#include "output/PolytopeVTKRecorder.hpp"
#include "output/VtkFiles.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

namespace yade {

using namespace vtkFiles;

namespace {

	bool holdsAny(const PolytopeBolt& bolt, const Scene& scene, const std::function<bool(const Body&)>& recorded)
	{
		return std::any_of(bolt.crossings.begin(), bolt.crossings.end(), [&](const auto& crossing) {
			const auto isRecorded = [&](Body::id_t id) { return scene.bodies->exists(id) && recorded(*(*scene.bodies)[id]); };
			return isRecorded(crossing->id1) || isRecorded(crossing->id2);
		});
	}

	/// Shear force of the crossing that an element is; zero if it is none.
	Vector3r shearOf(const PolytopeBolt& bolt, std::size_t element)
	{
		for (const auto& crossing : bolt.crossings)
			if (std::size_t(crossing->element) == element) return crossing->shearForce;
		return Vector3r::Zero();
	}

} // namespace

/// Each element of steel as a line between its stations, where the blocks have carried them; elements at an erased block have no place any more.
void PolytopeVTKRecorder::writeBolts(const string& file) const
{
	vtkNew<vtkPolyData>  data;
	vtkNew<vtkPoints>    points;
	vtkNew<vtkCellArray> lines;
	points->SetDataTypeToDouble();
	vtkCellData* const cells  = data->GetCellData();
	auto* const        number = column<vtkIntArray>(cells, "bolt");
	auto* const        broken = column<vtkIntArray>(cells, "broken");
	auto *const force = column<vtkDoubleArray>(cells, "force"), *const strain = column<vtkDoubleArray>(cells, "strain");
	auto* const shear  = column<vtkDoubleArray>(cells, "shearForce", 3);
	auto* const radius = column<vtkDoubleArray>(cells, "radius");

	for (const auto& engine : scene->engines) {
		const auto* const those = dynamic_cast<const PolytopeBolts*>(engine.get());
		if (!those) continue;
		for (std::size_t k = 0; k < those->bolts.size(); ++k) {
			const PolytopeBolt& bolt = *those->bolts[k];
			if (!holdsAny(bolt, *scene, [&](const Body& body) { return recorded(body); })) continue;
			const auto places = bolt.stationPoints(*scene->bodies);
			for (std::size_t e = 0; e + 1 < places.size(); ++e) {
				if (!places[e] || !places[e + 1]) continue;
				const vtkIdType ends[] = { points->GetNumberOfPoints(), points->GetNumberOfPoints() + 1 };
				append(points, *places[e]);
				append(points, *places[e + 1]);
				lines->InsertNextCell(2, ends);
				const polytope::BoltElement& element = bolt.chain.elements[e];
				number->InsertNextValue(int(k));
				broken->InsertNextValue(element.broken);
				force->InsertNextValue(double(element.force));
				strain->InsertNextValue(double(element.strain));
				append(shear, shearOf(bolt, e));
				radius->InsertNextValue(double(math::sqrt(bolt.area / Mathr::PI)));
			}
		}
	}
	data->SetPoints(points);
	data->SetLines(lines);
	stampTime(data, *scene);
	writeFile<vtkXMLPolyDataWriter>(data, file, ascii, compress);
}

} // namespace yade

#endif // YADE_VTK
