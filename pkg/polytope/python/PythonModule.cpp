// SPDX-License-Identifier: GPL-2.0-or-later
//
// The extension module yade._polytope: what yade.polytope (py/polytope/) needs beyond YADE's classes.
//
// It lives in the same library as the classes (_polytope.so). Plugin.cpp has loaded that at YADE's start; the first
// `from yade import _polytope` finds it through yade.__path__, and Python only calls the function below: YADE's own
// classes and converters are registered by then.
#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"
#include "contact/MarginContact.hpp"
#include "host/Extensions.hpp"
#include "host/Vectors.hpp"
#include "joint/JointOfParts.hpp"
#include "joint/RockJointPhys.hpp"
#include "material/RockJointMat.hpp"
#include "material/StiffnessRules.hpp"
#include "python/Arrays.hpp"
#include "python/PairContact.hpp"
#include "shape/Construction.hpp"
#include "shape/Polytope.hpp"
#include "shape/ShapeFamily.hpp"
#include "step/PotentialContacts.hpp"
#include "step/WorkerContacts.hpp"
#include "step/WorkerSums.hpp"

#include "BuildInfo.hpp"

#include <core/Body.hpp>
#include <core/Functor.hpp>

#include <src/bond/BondTolerances.hpp>
#include <src/centre/IpoptCentre.hpp>

#include <boost/python.hpp>

namespace py = boost::python;

namespace {

py::dict buildInfo()
{
	namespace info = polytope::buildInfo;
	py::dict result;
	result["version"]        = info::version;
	result["precision"]      = info::precision;
	result["bits"]           = int(std::numeric_limits<yade::Real>::digits);
	result["digits"]         = int(std::numeric_limits<yade::Real>::digits10);
	result["yadeVersion"]    = info::yadeVersion;
	result["yadeFeatures"]   = py::str(info::yadeFeatures).split();
	result["instructionSet"] = polytope::instructionSet();
	result["ipopt"]          = polytope::ipoptVersion() ? py::object(polytope::ipoptVersion()) : py::object();
	return result;
}

/// Planes with a face, corners, volume, centroid and inscribed ball of a set of half-spaces where it is.
py::dict polyhedron(const yade::Vectors& normals, const py::object& offsets)
{
	const polytope::HalfSpaces set
	        = polytope::withoutRedundant(polytope::withoutDuplicates(polytope::normalised({ normals.rows, yade::numbers(offsets) })));
	const auto hull    = polytope::polyhedron(set);
	const auto mass    = polytope::massProperties(hull);
	const auto central = polytope::moved(set, yade::Matrix3r::Identity(), -mass.centroid);
	py::dict   result;
	result["normals"]         = set.normals;
	result["offsets"]         = set.offsets;
	result["vertices"]        = hull.vertices;
	result["volume"]          = mass.volume;
	result["centroid"]        = mass.centroid;
	result["inscribedRadius"] = polytope::ConvexShape(central, 0).inscribedRadius();
	return result;
}

template <class Number> py::object bytesOf(const std::vector<Number>& numbers)
{
	return py::object(py::handle<>(
	        PyBytes_FromStringAndSize(reinterpret_cast<const char*>(numbers.data()), Py_ssize_t(numbers.size() * sizeof(Number)))));
}

/// Faces of a shape that are drawn; empty if it has none.
std::shared_ptr<const polytope::Polyhedron> facesOf(const yade::Shape& shape)
{
	const auto surface = yade::familyOf(shape).surface(shape);
	return surface ? surface : std::make_shared<const polytope::Polyhedron>();
}

/// A shape's vertices and faces as memory of NumPy arrays: as lists, of a number for each coordinate, they take a hundred times as long.
py::tuple packedFaces(const yade::Shape& shape)
{
	const auto          hull = facesOf(shape);
	std::vector<double> coordinates;
	std::vector<int>    counts, corners;
	for (const auto& vertex : hull->vertices)
		for (int axis = 0; axis < 3; ++axis)
			coordinates.push_back(double(vertex[axis]));
	for (const auto& face : hull->faces) {
		counts.push_back(int(face.size()));
		corners.insert(corners.end(), face.begin(), face.end());
	}
	return py::make_tuple(bytesOf(coordinates), bytesOf(counts), bytesOf(corners));
}

py::object planesOfFaces(const yade::Shape& shape) { return bytesOf(facesOf(shape)->planeOfFace); }

/// (normals, offsets) in world axes of a body as a piece of a support, as one at `other` meets it.
py::tuple supportPlanes(const boost::shared_ptr<yade::Body>& body, const yade::Vector3r& other)
{
	yade::Solid        solid;
	const yade::State& state = *body->state;
	yade::familyOf(*body->shape)
	        .addSupport(*body->shape, { state.pos, state.ori.toRotationMatrix(), other, std::numeric_limits<yade::Real>::infinity() },
	                solid);
	std::vector<double> normals, offsets;
	for (const auto& plane : solid.planes) {
		for (int axis = 0; axis < 3; ++axis)
			normals.push_back(double(plane.normal[axis]));
		offsets.push_back(double(plane.offset));
	}
	return py::make_tuple(bytesOf(normals), bytesOf(offsets));
}

/// What a class derived from Polytope leaves open, or has wrong; empty: nothing.
std::string faultOfShape(const yade::Polytope& shape)
{
	if (!shape.convex()) return "";
	if (!shape.margin()) return "does not say where its surface is (margin): volume, pictures and VTK files are those of its planes";
	return shape.faultOfFrame();
}

/// (path, name, names of classes)
py::tuple described(const yade::Extension& extension)
{
	py::list classes;
	for (const std::string& name : extension.classes)
		classes.append(name);
	return py::make_tuple(extension.path, extension.name, py::tuple(classes));
}

py::list extensions()
{
	py::list all;
	for (const yade::Extension& one : yade::extensions())
		all.append(described(one));
	return all;
}

py::tuple loadExtension(const std::string& path) { return described(yade::loadExtension(path)); }

/// Whether the time step before the first contact is that of the functor's own stiffnesses (GivesJointStiffness).
bool givesStiffnesses(const boost::shared_ptr<yade::Functor>& functor, const boost::shared_ptr<yade::Material>& material1,
        const boost::shared_ptr<yade::Material>& material2)
{
	const auto* const giver = dynamic_cast<const yade::GivesJointStiffness*>(functor.get());
	return giver && material1 && material2 && giver->stiffnesses(*material1, *material2, 1, 1, 1);
}

std::string faultOfClosure(const boost::shared_ptr<yade::JointClosure>& closure, const yade::Real& stiffness)
{
	return closure->fault(stiffness);
}

/// See JointOfParts.hpp.
bool continueBetween(const boost::shared_ptr<yade::Interaction>& whole, const boost::shared_ptr<yade::Body>& whole1,
        const boost::shared_ptr<yade::Body>& whole2, const boost::shared_ptr<yade::Body>& part1, const boost::shared_ptr<yade::Body>& part2)
{
	return yade::continueBetween(*yade::Omega::instance().getScene(), *whole, *whole1, *whole2, part1, part2);
}

/// Name of each status → answered().
py::dict statuses()
{
	py::dict result;
	for (int k = 0; k < polytope::contactStatusCount; ++k)
		result[polytope::statusName(polytope::ContactStatus(k))] = polytope::answered(polytope::ContactStatus(k));
	return result;
}

/// The time steps that PolytopeTimeStepper uses, for the present scene: [s], or None where nothing limits.
py::dict timeStepLimits()
{
	const auto              scene  = yade::Omega::instance().getScene();
	const auto              number = [](yade::Real step) { return yade::math::isfinite(step) ? py::object(step) : py::object(); };
	yade::PotentialContacts potential;
	py::dict                result;
	result["contacts"] = number(yade::contactLimit(*scene).step);
	result["material"] = number(potential.limit(*scene).step);
	return result;
}

/// Time steps of bodies, by id; None for bodies that nothing limits.
py::list timeStepsOfBodies()
{
	const auto              scene = yade::Omega::instance().getScene();
	yade::PotentialContacts potential;
	const auto              contacts = yade::contactSteps(*scene), material = potential.steps(*scene);
	py::list                steps;
	for (std::size_t id = 0; id < contacts.size(); ++id) {
		const yade::Real step = yade::math::min(contacts[id], material[id]);
		steps.append(yade::math::isfinite(step) ? py::object(step) : py::object());
	}
	return steps;
}

} // namespace

// The list of everything in the module, one statement per entry: long, but without a branch.
BOOST_PYTHON_MODULE(_polytope)
{
	py::docstring_options options(true, true, false);
	py::scope().attr("facingOfJoints") = double(polytope::tolerance::facingOfJoints);
	py::def("buildInfo", &buildInfo,
	        "Versions of the plug-in, of the YADE it was compiled for and of Ipopt (None where the build has none; it computes in "
	        "double whatever "
	        "the precision), and *precision*, the numbers' kind (double, longdouble, float128, mpfr150), with its significant *bits* "
	        "and decimal "
	        "*digits*, as a dictionary.");
	py::def("statuses", &statuses,
	        "Names of :yref:`PolytopeGeom.status`, and whether a query that ended so found what it was asked for (what *failures* of "
	        "stats() does not count), as a dictionary.");
	py::def("polyhedron", &polyhedron, (py::arg("normals"), py::arg("offsets")),
	        "Half-spaces without redundant ones, their vertices, volume, centroid and inscribed ball's radius, as a dictionary.");
	py::def("packedFaces", &packedFaces, py::arg("shape"),
	        "Faces of a shape, as bytes of NumPy arrays; empty for walls and spheres: vertices (n, 3) float64 in the body's frame, "
	        "number of corners of each face, "
	        "int32, and the corners of all faces one after another, int32.");
	py::def("planesOfFaces", &planesOfFaces, py::arg("shape"),
	        "As bytes of a NumPy array: index of the half-space of each face, int32; -1 for caps of a polygon and for what a margin "
	        "rounds.");
	py::def("supportPlanes", &supportPlanes, (py::arg("body"), py::arg("other")),
	        "Half-spaces, in world axes, that stand for a body as one whose centre is at *other* meets it, as bytes of NumPy arrays: "
	        "unit "
	        "normals (n, 3) and offsets, float64; empty for spheres.");
	py::def("faultOfShape", &faultOfShape, py::arg("shape"), "What a class derived from Polytope leaves open; empty: nothing.");
	py::def("faultOfFamily", &yade::faultOfFamily, py::arg("shape"),
	        "What is no size of all that the family of a shape says (ShapeFamily.hpp); empty: nothing.");
	py::def(
	        "marginOf", +[](const yade::Polytope& shape) { return shape.margin().value_or(0); }, py::arg("shape"),
	        "Radius of the ball around each point of a polytope [m]; 0 where it has none or does not say.");
	py::def("hasMarginCore", &yade::hasMarginCore, py::arg("shape"), "Whether a PolytopeMarginFunctor can meet such a body.");
	py::def("extensions", &extensions, "Extensions that are loaded: (path, name, names of classes) of each.");
	py::def("loadExtension", &loadExtension, py::arg("path"),
	        "Loads one, see polytope.load; RuntimeError with the reason where it does not fit.");
	py::def("givesStiffnesses", &givesStiffnesses, (py::arg("functor"), py::arg("material1"), py::arg("material2")),
	        "Whether an Ip2 functor of an extension says how stiff contacts of two materials can be "
	        "(GivesJointStiffness::stiffnesses).");
	py::def("faultOfClosure", &faultOfClosure, (py::arg("closure"), py::arg("stiffness")),
	        "What does not belong together in a normal law, of a material of this stiffness; empty: nothing.");
	py::def("stiffnessInSeries", &yade::stiffnessInSeries, (py::arg("k1"), py::arg("k2")),
	        "Stiffness of a joint between materials of these two, each giving half of the compliance: 2 k1 k2/(k1 + k2).");
	py::def("timeStepLimits", &timeStepLimits,
	        "Safe time steps [s] (src/timestep/StableTimeStep.hpp) from the present *contacts* and from the *material* of contacts "
	        "that may be, as "
	        "a dictionary; None where nothing limits.");
	py::def("timeStepsOfBodies", &timeStepsOfBodies,
	        "The smaller of both for each body [s], a list by id; None for one that nothing limits, and for members of clumps.");
	yade::defineVectors();
	yade::defineConstruction();
	yade::defineJointedRock();
	yade::defineArrays();
	yade::definePairContact();
	yade::defineWorkerContacts();
	yade::defineWorkerSums();

	py::def("continueBetween", &continueBetween,
	        (py::arg("whole"), py::arg("whole1"), py::arg("whole2"), py::arg("part1"), py::arg("part2")),
	        "The rock joint of a contact goes on between parts of its two bodies; whether these have a contact.");
}
