// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef YADE_VTK

#include "output/PolytopeVTKRecorder.hpp"

#include "contact/PolytopeGeom.hpp"
#include "host/ExactClass.hpp"
#include "joint/RockJointPhys.hpp"
#include "output/VtkFiles.hpp"
#include "shape/Polytope.hpp"

#include <core/Scene.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include <boost/filesystem.hpp>
#include <fstream>
#include <iomanip>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace yade {

POLYTOPE_CLASSES((PolytopeVTKRecorder));
CREATE_LOGGER(PolytopeVTKRecorder);

using namespace vtkFiles;

namespace {

	void appendColor(vtkUnsignedCharArray* array, const Vector3r& color)
	{
		unsigned char bytes[3];
		for (int k = 0; k < 3; ++k)
			bytes[k] = static_cast<unsigned char>(std::lround(255 * std::min(1.0, std::max(0.0, double(color[k])))));
		array->InsertNextTypedTuple(bytes);
	}

	/// The polyhedron as one cell, with vertices of its own. `faces`, `vertices`: buffers.
	void appendSolid(vtkUnstructuredGrid* grid, vtkPoints* points, const polytope::Polyhedron& solid, const Vector3r& position,
	        const Matrix3r& turn, std::vector<vtkIdType>& faces, std::vector<vtkIdType>& vertices)
	{
		const vtkIdType first = points->GetNumberOfPoints();
		vertices.clear();
		for (const Vector3r& vertex : solid.vertices) {
			vertices.push_back(points->GetNumberOfPoints());
			append(points, position + turn * vertex);
		}
		faces.clear(); // each face as its number of vertices and the vertices
		for (const auto& face : solid.faces) {
			faces.push_back(vtkIdType(face.size()));
			for (int vertex : face)
				faces.push_back(first + vertex);
		}
		// told its vertices: VTK would search for them among the faces' corners, which takes longer than all else here
		grid->InsertNextCell(
		        VTK_POLYHEDRON, vtkIdType(vertices.size()), vertices.data(), vtkIdType(solid.faces.size()), faces.data());
	}

} // namespace

bool PolytopeVTKRecorder::has(const string& recorder) const
{
	return std::find(recorders.begin(), recorders.end(), recorder) != recorders.end();
}

bool PolytopeVTKRecorder::recorded(const Body& body) const { return mask == 0 || body.maskCompatible(mask); }

string PolytopeVTKRecorder::snapshotName(const string& recorder, long step, const string& extension) const
{
	return fileName + recorder + "." + std::to_string(step) + "." + extension;
}

void PolytopeVTKRecorder::postLoad(PolytopeVTKRecorder&)
{
	checked_.check(std::tie(recorders), [&] {
		for (const string& recorder : recorders)
			if (recorder != "bodies" && recorder != "contacts" && recorder != "bonds" && recorder != "bolts")
				throw std::invalid_argument(
				        "recorders: must be among 'bodies', 'contacts', 'bonds' and 'bolts', not '" + recorder + "'");
	});
}

void PolytopeVTKRecorder::action()
{
	const auto folder = boost::filesystem::path(fileName + "x").parent_path();
	if (!folder.empty()) boost::filesystem::create_directories(folder);

	while (!steps.empty() && steps.back() >= scene->iter) {
		steps.pop_back();
		times.pop_back();
	}
	steps.push_back(int(scene->iter));
	times.push_back(scene->time);

	if (has("bodies")) {
		writeBodies(snapshotName("bodies", scene->iter, "vtu"));
		writeSeries("bodies", "vtu");
	}
	if (has("contacts")) {
		writeContacts(snapshotName("contacts", scene->iter, "vtp"));
		writeSeries("contacts", "vtp");
	}
	if (has("bonds")) {
		writeBonds(snapshotName("bonds", scene->iter, "vtp"));
		writeSeries("bonds", "vtp");
	}
	if (has("bolts")) {
		writeBolts(snapshotName("bolts", scene->iter, "vtp"));
		writeSeries("bolts", "vtp");
	}
}

void PolytopeVTKRecorder::writeBodies(const string& file) const
{
	vtkNew<vtkUnstructuredGrid> grid;
	vtkNew<vtkPoints>           points;
	points->SetDataTypeToDouble(); // overlaps are smaller than single precision resolves
	vtkCellData* const cells           = grid->GetCellData();
	auto* const        id              = column<vtkIntArray>(cells, "id");
	auto* const        color           = column<vtkUnsignedCharArray>(cells, "color", 3);
	auto* const        groupMask       = column<vtkIntArray>(cells, "mask");
	auto* const        materialId      = column<vtkIntArray>(cells, "materialId");
	auto* const        dynamic         = column<vtkUnsignedCharArray>(cells, "dynamic");
	auto* const        mass            = column<vtkDoubleArray>(cells, "mass");
	auto* const        velocity        = column<vtkDoubleArray>(cells, "velocity", 3);
	auto* const        angularVelocity = column<vtkDoubleArray>(cells, "angularVelocity", 3);
	auto* const        displacement    = column<vtkDoubleArray>(cells, "displacement", 3);

	std::vector<vtkIdType> faces, vertices;
	for (const auto& body : *scene->bodies) {
		if (!body || !body->shape || !recorded(*body) || (skipNondynamic && !body->isDynamic())) continue;
		const auto* const shape = dynamic_cast<const Polytope*>(body->shape.get());
		const auto        solid = shape ? shape->surface() : nullptr;
		if (!solid) continue;
		const State& state = *body->state;
		appendSolid(grid, points, *solid, insideCell(*scene, state.pos), state.ori.toRotationMatrix(), faces, vertices);
		id->InsertNextValue(body->getId());
		appendColor(color, shape->color);
		groupMask->InsertNextValue(int(body->groupMask));
		materialId->InsertNextValue(body->material ? body->material->id : -1);
		dynamic->InsertNextValue(body->isDynamic());
		mass->InsertNextValue(double(state.mass));
		append(velocity, state.vel);
		append(angularVelocity, state.angVel);
		append(displacement, state.pos - state.refPos);
	}
	grid->SetPoints(points);
	stampTime(grid, *scene);
	writeFile<vtkXMLUnstructuredGridWriter>(grid, file, ascii, compress);
}

void PolytopeVTKRecorder::writeContacts(const string& file) const
{
	vtkNew<vtkPolyData>  data;
	vtkNew<vtkPoints>    points;
	vtkNew<vtkCellArray> vertices;
	points->SetDataTypeToDouble();
	vtkPointData* const at            = data->GetPointData();
	auto* const         id1           = column<vtkIntArray>(at, "id1");
	auto* const         id2           = column<vtkIntArray>(at, "id2");
	auto* const         normal        = column<vtkDoubleArray>(at, "normal", 3);
	auto* const         normalForce   = column<vtkDoubleArray>(at, "normalForce", 3);
	auto* const         shearForce    = column<vtkDoubleArray>(at, "shearForce", 3);
	auto* const         depth         = column<vtkDoubleArray>(at, "depth");
	auto* const         area          = column<vtkDoubleArray>(at, "area");
	auto* const         infeasibility = column<vtkDoubleArray>(at, "infeasibility");
	auto* const         status        = column<vtkIntArray>(at, "status");

	for (const auto& interaction : *scene->interactions) {
		if (!interaction->isReal()) continue;
		const auto* const   polytopes = asClass<PolytopeGeom>(interaction->geom.get());
		const ScGeom* const geom      = polytopes ? polytopes : dynamic_cast<const ScGeom*>(interaction->geom.get());
		if (!geom) continue;
		const auto &body1 = Body::byId(interaction->getId1(), scene), &body2 = Body::byId(interaction->getId2(), scene);
		if (!body1 || !body2 || !(recorded(*body1) || recorded(*body2))) continue;
		const NormShearPhys* phys = exactly<RockJointPhys>(interaction->phys.get());
		if (!phys) phys = dynamic_cast<const NormShearPhys*>(interaction->phys.get());
		const vtkIdType point = points->GetNumberOfPoints();
		append(points, insideCell(*scene, geom->contactPoint));
		vertices->InsertNextCell(1, &point);
		id1->InsertNextValue(interaction->getId1());
		id2->InsertNextValue(interaction->getId2());
		append(normal, geom->normal);
		append(normalForce, phys ? phys->normalForce : Vector3r::Zero());
		append(shearForce, phys ? phys->shearForce : Vector3r::Zero());
		depth->InsertNextValue(double(geom->penetrationDepth));
		area->InsertNextValue(polytopes ? double(polytopes->contactArea) : 0);
		infeasibility->InsertNextValue(polytopes ? double(polytopes->infeasibility) : 0);
		status->InsertNextValue(polytopes ? int(polytopes->statusCode) : int(polytope::ContactStatus::Contact));
	}
	data->SetPoints(points);
	data->SetVerts(vertices);
	stampTime(data, *scene);
	auto* const names = column<vtkStringArray>(data->GetFieldData(), "statusNames");
	for (int code = 0; code < polytope::contactStatusCount; ++code)
		names->InsertNextValue(polytope::statusName(polytope::ContactStatus(code)));
	writeFile<vtkXMLPolyDataWriter>(data, file, ascii, compress);
}

/// ParaView's list of a series: each snapshot's file, relative to the list, and its time.
void PolytopeVTKRecorder::writeSeries(const string& recorder, const string& extension) const
{
	std::ofstream list(fileName + recorder + ".pvd");
	list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n\t<Collection>\n";
	for (std::size_t k = 0; k < steps.size(); ++k) {
		const auto file = boost::filesystem::path(snapshotName(recorder, steps[k], extension)).filename().string();
		list << "\t\t<DataSet timestep=\"" << std::setprecision(17) << double(times[k]) << "\" file=\"" << file << "\"/>\n";
	}
	list << "\t</Collection>\n</VTKFile>\n";
	if (!list) throw std::runtime_error("PolytopeVTKRecorder.fileName: cannot write " + fileName + recorder + ".pvd");
}

} // namespace yade

#endif // YADE_VTK
