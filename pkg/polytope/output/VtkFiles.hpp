// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#ifdef YADE_VTK

#include "output/VtkCompressor.hpp"

#include <core/Cell.hpp>
#include <core/Scene.hpp>

#include <stdexcept>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>

/// What the recorders of bodies, contacts, bonds and bolts share: columns of a data set, points, and the file.
namespace yade::vtkFiles {

/// An array of the data set's attributes under this name; the attributes own it.
template <class Array> Array* column(vtkFieldData* attributes, const char* name, int components = 1)
{
	vtkNew<Array> array;
	array->SetName(name);
	array->SetNumberOfComponents(components);
	attributes->AddArray(array);
	return array;
}

inline void append(vtkDoubleArray* array, const Vector3r& vector)
{
	double* const to = array->WritePointer(array->GetNumberOfValues(), 3);
	for (int k = 0; k < 3; ++k)
		to[k] = double(vector[k]);
}

inline void append(vtkPoints* points, const Vector3r& point)
{
	points->InsertNextPoint(double(point[0]), double(point[1]), double(point[2]));
}

inline Vector3r insideCell(const Scene& scene, const Vector3r& point)
{
	return scene.isPeriodic ? scene.cell->wrapShearedPt(point) : point;
}

/// Readers take this as the snapshot's time even without the series' list.
inline void stampTime(vtkDataObject* data, const Scene& scene)
{
	column<vtkDoubleArray>(data->GetFieldData(), "TimeValue")->InsertNextValue(double(scene.time));
}

template <class Writer> void writeFile(vtkDataObject* data, const string& file, bool ascii, bool compress)
{
	vtkNew<Writer> writer;
	writer->SetFileName(file.c_str());
	writer->SetInputData(data);
	if (ascii) writer->SetDataModeToAscii();
	else {
		writer->SetDataModeToAppended();
		writer->EncodeAppendedDataOff();
	}
	if (compress && !ascii) {
		writer->SetCompressor(vtkNew<FastZlib>());
		writer->SetBlockSize(1 << 18); // repeats are farther apart than in VTK's own 32 kB
	} else writer->SetCompressorTypeToNone();
	writer->SetIdTypeToInt32(); // half the bytes to compress; there is no scene with 2³¹ corners of faces
	if (!writer->Write()) throw std::runtime_error("PolytopeVTKRecorder.fileName: cannot write " + file);
}

} // namespace yade::vtkFiles

#endif // YADE_VTK
