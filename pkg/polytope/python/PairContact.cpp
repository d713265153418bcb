// SPDX-License-Identifier: GPL-2.0-or-later
#include "python/PairContact.hpp"

#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"
#include "material/RockJointMat.hpp"
#include "material/StiffnessRules.hpp"
#include "shape/Polytope.hpp"

#include <core/Body.hpp>

#include <boost/python.hpp>

namespace py = boost::python;

namespace {

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
	static const yade::Ig2_Polytope_Polytope_PolytopeGeom defaults;
	yade::Ig2_Polytope_Polytope_PolytopeGeom              functor; // which checks them
	functor.contactModel    = given(contactModel, ofScene.contactModel);
	const auto& ofModel     = functor.contactModel == ofScene.contactModel ? ofScene : defaults; // the scene's are options of its model
	functor.contactPoint    = given(contactPoint, ofModel.contactPoint);
	functor.solver          = given(solver, ofModel.solver);
	functor.tolerance       = given(tolerance, ofScene.tolerance);
	functor.newtonTolerance = given(newtonTolerance, ofScene.newtonTolerance);
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

template <class T, T polytope::ContactResult::* Member> T field(const Contact& contact) { return contact.result.*Member; }

} // namespace

namespace yade {

void definePairContact()
{
	using polytope::ContactResult;

	py::class_<Contact>("Contact", "The contact of two bodies as yade.polytope.contact found it.", py::no_init)
	        .add_property("inContact", &field<bool, &ContactResult::inContact>, "Whether the bodies touch: s* < −tolerance.")
	        .add_property("status", &Contact::status, "As :yref:`PolytopeGeom.status`.")
	        .add_property("infeasibility", &field<Real, &ContactResult::infeasibility>,
	                "Optimum s* of the phase-one linear program [m] (Boon et al. 2012, Eq. 9): minus the radius of the largest ball in "
	                "the overlap.")
	        .add_property(
	                "point", +[](const Contact& c) { return c.point; },
	                "Contact point, world coordinates [m]: on the line of action of the surface's pressure; boon2012: the analytic "
	                "centre of all half-spaces (Eq. 10), across a gap of both bodies grown until they just overlap.")
	        .add_property("normal", &field<Vector3r, &ContactResult::normal>,
	                "Unit contact normal from b1 to b2, the direction of the force; boon2012: Eqs 13-17.")
	        .add_property("depth", &field<Real, &ContactResult::depth>,
	                "Force over stiffness (foundation: over stiffness and area), positive in overlap [m]; boon2012: the chord along "
	                "the normal through the point.")
	        .add_property("energyPerStiffness", &field<Real, &ContactResult::energy>,
	                "Models foundation and spring: elastic energy over the normal stiffness [m²], foundation's per area.")
	        .add_property("turningArm", &field<Real, &ContactResult::turningArm>,
	                "Models foundation and spring: moment about the normal that a force at the point leaves out, over that force [m].")
	        .add_property("area", &field<Real, &ContactResult::area>,
	                "Area of the contact surface seen along the normal [m²], boon2012: of the section through the point; polygons: "
	                "length times thickness.")
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
	py::def("contact", &contact,
	        (py::arg("b1"), py::arg("b2"), py::arg("contactPoint") = py::object(), py::arg("tolerance") = py::object(),
	                py::arg("newtonTolerance") = py::object(), py::arg("solver") = py::object(),
	                py::arg("contactModel") = py::object()),
	        "Contact of two bodies with Polytope shapes at their present poses, in the scene or not: that which they have with the "
	        "scene's settings, but for what is given here (periodic images are not searched).\n\n"
	        ":param Body b1: first body\n"
	        ":param Body b2: second body; the normal points towards it\n"
	        ":param str contactPoint, float tolerance, float newtonTolerance, str solver, str contactModel: as on "
	        ":yref:`Ig2_Polytope_Polytope_PolytopeGeom`; default those of the scene's, without engines its defaults\n"
	        ":returns: object with inContact, status, infeasibility, point, normal, depth, area, sectionCentroid, dualDirection, "
	        "newtonIterations, ipoptIterations, simplexPivots\n"
	        ":raises ValueError: naming the argument: no Polytope, different dimensions, unknown contactPoint, contactModel or solver, "
	        "solver 'ipopt' in a build without, tolerances out of range");
}

} // namespace yade
