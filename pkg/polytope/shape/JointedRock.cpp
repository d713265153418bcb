// SPDX-License-Identifier: GPL-2.0-or-later
//
// What jointedRock.py and rock/ of py/polytope call: a rock mass cut into blocks, areas of joints. Arrays of doubles and of 32-bit integers
// go back as bytes, as NumPy reads them.
#include "shape/Construction.hpp"

#include "host/Vectors.hpp"

#include <src/cutting/JointAreas.hpp>
#include <src/cutting/JointedBlocks.hpp>

#include <boost/python.hpp>

namespace py = boost::python;

namespace yade {
namespace {

	py::object packed(const void* data, std::size_t size)
	{
		return py::object(py::handle<>(PyBytes_FromStringAndSize(static_cast<const char*>(data), Py_ssize_t(size))));
	}

	template <class Number> py::object packed(const std::vector<Number>& numbers)
	{
		return packed(numbers.data(), numbers.size() * sizeof(Number));
	}

	/// Rows a·x = d.
	std::vector<polytope::Plane> planesIn(const py::object& rows)
	{
		const auto                   normals = py::extract<const Vectors&>(rows[0])();
		const std::vector<Real>      offsets = numbers(py::object(rows[1]));
		std::vector<polytope::Plane> planes;
		for (std::size_t i = 0; i < normals.rows.size(); ++i)
			planes.push_back({ normals.rows[i], offsets.at(i) });
		return planes;
	}

	/// (planes, centres, radii, edges of all, number of edges of each, persistences), planes as (normals, offsets).
	std::vector<polytope::FiniteJoint> jointsOf(const py::object& given)
	{
		const auto              planes = planesIn(given[0]), edges = planesIn(given[3]);
		const auto              centres = py::extract<const Vectors&>(given[1])();
		const std::vector<Real> radii = numbers(py::object(given[2])), counts = numbers(py::object(given[4])),
		                        persistences = numbers(py::object(given[5]));
		std::vector<polytope::FiniteJoint> joints;
		auto                               edge = edges.begin();
		for (std::size_t j = 0; j < planes.size(); ++j) {
			const auto end = edge + std::ptrdiff_t(counts.at(j));
			joints.push_back({ planes[j], centres.rows.at(j), radii.at(j), { edge, end }, persistences.at(j) });
			edge = end;
		}
		return joints;
	}

	std::vector<polytope::HalfSpaces> regionsOf(const py::object& given)
	{
		std::vector<polytope::HalfSpaces> regions;
		for (py::ssize_t i = 0; i < py::len(given); ++i)
			regions.push_back({ py::extract<const Vectors&>(given[i][0])().rows, numbers(py::object(given[i][1])), 3 });
		return regions;
	}

	/// Area of each joint inside regions that do not overlap: doubles as NumPy reads them.
	py::object jointAreas(const py::object& regions, const py::object& given)
	{
		std::vector<double> areas;
		for (const Real& area : polytope::areasWithin(regionsOf(regions), jointsOf(given)))
			areas.push_back(double(area));
		return packed(areas);
	}

	/// Bodies of regions cut by joints, in arrays of doubles (and of 32-bit integers) as NumPy reads them.
	py::dict jointedBlocks(
	        const py::object& regions, const py::object& given, Real smallest, Real bridge, std::size_t most, std::size_t seed)
	{
		const auto          rock = polytope::cutByJoints(regionsOf(regions), jointsOf(given), { smallest, bridge, most, seed });
		std::vector<double> planes, volumes, areas, sections;
		std::vector<int>    counts, labels;
		for (const polytope::Block& block : rock.blocks) {
			for (int plane : block.planes) {
				const auto& [normal, offset] = rock.planes[std::size_t(plane)];
				planes.insert(planes.end(), { double(normal[0]), double(normal[1]), double(normal[2]), double(offset) });
				labels.push_back(plane < int(rock.firstJoint) ? -1 : (plane - int(rock.firstJoint)) / 2);
			}
			counts.push_back(int(block.planes.size()));
			volumes.push_back(double(block.volume()));
		}
		for (std::size_t j = 0; j < rock.areas.size(); ++j) {
			areas.push_back(double(rock.areas[j]));
			sections.push_back(double(rock.sections[j]));
		}
		py::dict result;
		result["planes"]   = packed(planes);
		result["labels"]   = packed(labels);
		result["counts"]   = packed(counts);
		result["volumes"]  = packed(volumes);
		result["bodies"]   = packed(rock.bodies);
		result["areas"]    = packed(areas);
		result["sections"] = packed(sections);
		result["uncut"]    = rock.uncut;
		return result;
	}

} // namespace

void defineJointedRock()
{
	py::def("jointAreas", &jointAreas, "Area of each joint inside regions, given as for jointedBlocks.");
	py::def("jointedBlocks", &jointedBlocks,
	        "Blocks of regions cut by joints: [(normals, offsets)], (planes, centres, radii, edges, counts of edges, persistences), "
	        "smallest, bridge, most, seed.");
}

} // namespace yade
