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
#include "shape/Construction.hpp"
#include "shape/Polytope.hpp"
#include "shape/ShapeFamily.hpp"
#include "step/PotentialContacts.hpp"
#include "step/WorkerContacts.hpp"
#include "step/WorkerSums.hpp"

#include "BuildInfo.hpp"

#include <core/Body.hpp>
#include <core/Functor.hpp>

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

py::dict tolerances()
{
	namespace tolerance = polytope::tolerance;
	py::dict result;
	result["rounding"]       = double(tolerance::rounding);
	result["depth"]          = double(tolerance::depth);
	result["coarsestNewton"] = double(tolerance::coarsestNewton);
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

/// Null for None. Anything but a body is refused by the argument's name: Boost's own message would list C++ types.
boost::shared_ptr<yade::Body> bodyOf(const py::object& given, const char* name)
{
	const py::extract<boost::shared_ptr<yade::Body>> body(given);
	if (!body.check()) {
		const std::string type = py::extract<std::string>(given.attr("__class__").attr("__name__"));
		throw std::invalid_argument(std::string(name)
		        + ": must be a body with a Polytope shape, as polytope.cuboid(…) makes it or O.bodies[…] has it, not of type "
		        + type);
	}
	return body();
}

const polytope::ConvexShape& convexOf(const boost::shared_ptr<yade::Body>& body, const char* name)
{
	const auto* shape = body ? dynamic_cast<const yade::Polytope*>(body->shape.get()) : nullptr;
	if (!shape || !shape->convex())
		throw std::invalid_argument(std::string(name) + ": must be a body with a Polytope shape that has planes");
	const auto& state = *body->state;
	using yade::math::isfinite;
	const std::string what = std::string(name) + ": its position and orientation ";
	if (!isfinite(state.pos.sum() + state.ori.coeffs().sum())) throw std::invalid_argument(what + "must be finite");
	if (!isfinite(state.pos.squaredNorm() + state.ori.squaredNorm()))
		throw std::invalid_argument(what + "are too large to be squared; move the bodies nearer to the origin");
	return *shape->convex();
}

/// One pair as it is, without a scene.
struct Contact {
	polytope::ContactResult result;
	yade::Vector3r          point, sectionCentroid;

	std::string status() const { return polytope::statusName(result.status); }
};

/// The rule for the stiffness of a contact of two bodies in the scene: what its engines say, or, without such engines, the materials.
yade::StiffnessRule ruleOf(const yade::Body& body1, const yade::Body& body2)
{
	const auto &material1 = body1.material, &material2 = body2.material;
	if (!material1 || !material2) return yade::StiffnessRule::Unknown;
	const auto rule = yade::stiffnessRuleOfNew(*yade::Omega::instance().getScene(), *material1, *material2);
	return rule != yade::StiffnessRule::Unknown ? rule : yade::stiffnessRuleOf(*material1, *material2);
}

/// What is given, and for None what the scene has.
template <class Value> Value given(const py::object& value, const Value& ofScene)
{
	return value.is_none() ? ofScene : py::extract<Value>(value)();
}

Contact contact(const py::object& b1, const py::object& b2, const py::object& contactPoint, const py::object& tolerance,
        const py::object& newtonTolerance, const py::object& solver, const py::object& contactModel)
{
	const auto  body1 = bodyOf(b1, "b1"), body2 = bodyOf(b2, "b2");
	const auto& convex1 = convexOf(body1, "b1");
	const auto& convex2 = convexOf(body2, "b2");
	if (convex1.dimension() != convex2.dimension())
		throw std::invalid_argument("b2: a polygon and a polyhedron cannot touch; both must have the same dimension");
	const auto& ofScene = yade::Ig2_Polytope_Polytope_PolytopeGeom::orDefault(*yade::Omega::instance().getScene());
	yade::Ig2_Polytope_Polytope_PolytopeGeom functor; // which checks them
	functor.contactPoint    = given(contactPoint, ofScene.contactPoint);
	functor.tolerance       = given(tolerance, ofScene.tolerance);
	functor.newtonTolerance = given(newtonTolerance, ofScene.newtonTolerance);
	functor.solver          = given(solver, ofScene.solver);
	functor.contactModel    = given(contactModel, ofScene.contactModel);
	functor.callPostLoad();
	polytope::ContactSettings settings(functor.options(ruleOf(*body1, *body2)));
	settings.energy            = true;
	settings.section           = true;
	settings.geometryAcrossGap = true;
	settings.normalWeight[0]   = yade::normalWeightOfFirst(body1.get(), body2.get());
	settings.normalWeight[1]   = 1 - settings.normalWeight[0];

	polytope::PairMemory       memory;
	polytope::ContactWorkspace workspace;
	Contact                    answer;
	const yade::Vector3r       centre2 = body2->state->pos - body1->state->pos;
	polytope::contactQuery({ convex1, body1->state->ori.toRotationMatrix(), convex2, body2->state->ori.toRotationMatrix(), centre2 },
	        settings, memory, workspace, answer.result);
	answer.point           = body1->state->pos + answer.result.point;
	answer.sectionCentroid = body1->state->pos + answer.result.sectionCentroid;
	return answer;
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

template <class T, T polytope::ContactResult::* Member> T field(const Contact& contact) { return contact.result.*Member; }

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
	using polytope::ContactResult;
	using yade::Real;
	using yade::Vector3r;

	py::docstring_options options(true, true, false);
	py::def("buildInfo", &buildInfo,
	        "Versions of the plug-in, of the YADE it was compiled for and of Ipopt (None where the build has none; it computes in "
	        "double whatever "
	        "the precision), and *precision*, the numbers' kind (double, longdouble, float128, mpfr150), with its significant *bits* "
	        "and decimal "
	        "*digits*, as a dictionary.");
	py::def("tolerances", &tolerances,
	        "Tolerances of the numerical core that the module's advice refers to, see src/numbers/Tolerances.hpp: *rounding* of this "
	        "precision's "
	        "numbers, *depth*, over the size, to which the kernel keeps the depth, and *coarsestNewton*, the largest newtonTolerance.");
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
	yade::defineWorkerContacts();
	yade::defineWorkerSums();

	py::class_<Contact>("Contact", "The contact of two bodies as yade.polytope.contact found it.", py::no_init)
	        .add_property("inContact", &field<bool, &ContactResult::inContact>, "Whether the bodies touch: s* < −tolerance.")
	        .add_property("status", &Contact::status, "As :yref:`PolytopeGeom.status`.")
	        .add_property("infeasibility", &field<Real, &ContactResult::infeasibility>,
	                "Optimum s* of the phase-one linear program [m] (Boon et al. 2012, Eq. 9): minus the radius of the largest ball "
	                "in the overlap.")
	        .add_property(
	                "point", +[](const Contact& c) { return c.point; },
	                "Contact point, world coordinates [m]: on the line of action of the surface's pressure; boon2012: the analytic "
	                "centre "
	                "of all half-spaces (Eq. 10), across a gap of both bodies grown until they just overlap.")
	        .add_property("normal", &field<Vector3r, &ContactResult::normal>,
	                "Unit contact normal from b1 to b2, the direction of the force; boon2012: Eqs 13-17.")
	        .add_property("depth", &field<Real, &ContactResult::depth>,
	                "Force over stiffness (foundation: over stiffness and area), positive in overlap [m]; boon2012: the chord along "
	                "the normal "
	                "through the point.")
	        .add_property("energyPerStiffness", &field<Real, &ContactResult::energy>,
	                "Models foundation and spring: elastic energy over the normal stiffness [m²], foundation's per area.")
	        .add_property("turningArm", &field<Real, &ContactResult::turningArm>,
	                "Models foundation and spring: moment about the normal that a force at the point leaves out, over that force [m].")
	        .add_property("area", &field<Real, &ContactResult::area>,
	                "Area of the contact surface seen along the normal [m²], boon2012: of the section through the point; polygons: "
	                "length "
	                "times thickness.")
	        .add_property(
	                "sectionCentroid", +[](const Contact& c) { return c.sectionCentroid; },
	                "Centroid of the contact section, world coordinates [m].")
	        .add_property("dualDirection", &field<Vector3r, &ContactResult::dualDirection>,
	                "Σ over b1's planes of λ_i a_i, λ the linear program's dual: moved by ``|s*|/|dualDirection|`` along it, b2 is "
	                "free of b1.")
	        .add_property("newtonIterations", &field<int, &ContactResult::newtonIterations>, "Iterations of the analytic centre.")
	        .add_property(
	                "ipoptIterations", &field<int, &ContactResult::ipoptIterations>, "Iterations of Ipopt, 0 where it was not needed.")
	        .add_property("simplexPivots", &field<int, &ContactResult::simplexPivots>, "Pivots of the linear program.");
	py::def("continueBetween", &continueBetween,
	        (py::arg("whole"), py::arg("whole1"), py::arg("whole2"), py::arg("part1"), py::arg("part2")),
	        "The rock joint of a contact goes on between parts of its two bodies; whether these have a contact.");
	py::def("contact", &contact,
	        (py::arg("b1"), py::arg("b2"), py::arg("contactPoint") = py::object(), py::arg("tolerance") = py::object(),
	                py::arg("newtonTolerance") = py::object(), py::arg("solver") = py::object(),
	                py::arg("contactModel") = py::object()),
	        "Contact of two bodies with Polytope shapes at their present poses, in the scene or not: that which they have with the "
	        "scene's "
	        "settings, but for what is given here (periodic images are not searched).\n\n"
	        ":param Body b1: first body\n"
	        ":param Body b2: second body; the normal points towards it\n"
	        ":param str contactPoint, float tolerance, float newtonTolerance, str solver, str contactModel: as on "
	        ":yref:`Ig2_Polytope_Polytope_PolytopeGeom`; default those of the scene's, without engines its defaults\n"
	        ":returns: object with inContact, status, infeasibility, point, normal, depth, area, sectionCentroid, dualDirection, "
	        "newtonIterations, "
	        "ipoptIterations, simplexPivots\n"
	        ":raises ValueError: naming the argument: no Polytope, different dimensions, unknown contactPoint, contactModel or solver, "
	        "solver 'ipopt' in a build without, tolerances out of range");
}
