// SPDX-License-Identifier: GPL-2.0-or-later
//
// What polytopes.py and clumps.py of py/polytope/bodies call: a shape made by ShapeFactory, a body made of it, what parts of a clump fill together.
#include "shape/Construction.hpp"

#include "host/Vectors.hpp"
#include "shape/ShapeOfBody.hpp"

#include <core/Body.hpp>
#include <core/Clump.hpp>
#include <core/Material.hpp>
#include <core/State.hpp>

#include <src/cutting/UnionOfParts.hpp>
#include <src/shape/RegularSolids.hpp>
#include <src/shape/ShapeFactory.hpp>

#include <boost/python.hpp>

namespace py = boost::python;

namespace yade {
namespace {

	using polytope::CentralShape;
	using polytope::HalfSpaces;

	/// cornerRadius None: cornerFraction of the inscribed radius.
	polytope::ShapeOptions options(Real thickness, bool keepRedundant, const py::object& cornerRadius, Real cornerFraction)
	{
		polytope::ShapeOptions result;
		result.thickness      = thickness;
		result.keepRedundant  = keepRedundant;
		result.cornerFraction = cornerFraction;
		if (!cornerRadius.is_none()) result.cornerRadius = Real(py::extract<Real>(cornerRadius));
		return result;
	}

	CentralShape ofHalfSpaces(const Vectors& normals, const py::object& offsets, int dimension, Real thickness, bool keepRedundant,
	        const py::object& cornerRadius, Real cornerFraction)
	{
		return polytope::centralShape(
		        { normals.rows, numbers(offsets), dimension }, options(thickness, keepRedundant, cornerRadius, cornerFraction));
	}

	CentralShape ofPoints(
	        const Vectors& points, int dimension, Real coplanar, Real thickness, const py::object& cornerRadius, Real cornerFraction)
	{
		return polytope::centralHull(points.rows, dimension, coplanar, options(thickness, true, cornerRadius, cornerFraction));
	}

	CentralShape ofRegular(int faces, Real circumradius, const py::object& cornerRadius, Real cornerFraction)
	{
		return polytope::centralShape(polytope::regularSolid(faces, circumradius), options(1, true, cornerRadius, cornerFraction));
	}

	CentralShape ofCuboid(const Vector3r& half, const py::object& cornerRadius, Real cornerFraction)
	{
		if (!(half.minCoeff() > 0)) throw std::invalid_argument("extents: half-lengths must be positive");
		return polytope::centralShape(polytope::cuboid(half), options(1, true, cornerRadius, cornerFraction));
	}

	/// Shape, mass, degrees of freedom; the state's place is the caller's.
	void giveShape(Body& body, const shared_ptr<Polytope>& shape, bool fixed, Real isotropyTolerance)
	{
		State&         state   = *body.state;
		const Real     density = body.material->density;
		const Vector3r inertia = shape->inertia();
		body.shape             = shape;
		state.mass             = shape->volume() * density;
		state.inertia          = inertia * density;
		state.refPos           = state.pos; // displacements count from there
		state.refOri           = state.ori;
		const bool flat        = shape->dimension == 2;
		state.blockedDOFs      = fixed ? State::DOF_ALL : flat ? State::DOF_Z | State::DOF_RX | State::DOF_RY : State::DOF_NONE;
		// a polygon turns about z only, so its other moments never enter
		body.setAspherical(!flat && inertia.maxCoeff() - inertia.minCoeff() > isotropyTolerance * inertia.maxCoeff());
	}

	/// A body whose centroid is at `centre`, or None: where its planes or points are; turned about it. Without a colour (None) the shape keeps its own.
	shared_ptr<Body> body(const CentralShape& central, const shared_ptr<Material>& material, const py::object& centre,
	        const Quaternionr& turn, bool fixed, Real isotropyTolerance, const py::object& color)
	{
		const auto shape = Polytope::of(central.shape);
		auto       body  = shared_ptr<Body>(new Body);
		body->material   = material;
		body->state      = material->newAssocState();
		body->state->pos = centre.is_none() ? central.position : Vector3r(py::extract<Vector3r>(centre));
		body->state->ori = turn * Quaternionr(Matrix3r(central.rotation));
		giveShape(*body, shape, fixed, isotropyTolerance);
		if (!color.is_none()) shape->color = py::extract<Vector3r>(color);
		body->setBounded(true);
		return body;
	}

	/// Another shape for a body: the planes of its own, in the frame that the new class' margin asks for. Mass and principal axes follow; nothing moves.
	void reshape(const shared_ptr<Body>& body, const shared_ptr<Polytope>& shape, Real isotropyTolerance)
	{
		const Polytope&           own    = *polytopeOf(*body);
		const std::optional<Real> margin = shape->margin();
		if (!margin) throw std::invalid_argument("shape: its class does not say where its surface is (Polytope::margin)");
		if (!(*margin >= 0 && math::isfinite(*margin)))
			throw std::invalid_argument("shape: its margin must be finite and at least 0");
		if (*margin > 0 && own.dimension == 2)
			throw std::invalid_argument("body: is a polygon, which has no margin; make a polyhedron");
		polytope::ShapeOptions options;
		options.thickness    = own.convex()->thickness();
		options.cornerRadius = own.convex()->cornerRadius();
		options.margin       = *margin;
		const auto central   = polytope::centralShape(own.convex()->planes(), options);
		shape->take(central.shape);
		if (const std::string fault = shape->faultOfFrame(); !fault.empty()) throw std::invalid_argument("shape: " + fault);
		shape->color     = own.color;
		shape->wire      = own.wire;
		shape->highlight = own.highlight;
		if (shape->planeOffsets().size() == own.planeOffsets().size()) shape->faceMaterials = own.faceMaterials;
		State& state = *body->state;
		state.pos += state.ori * central.position;
		state.ori = state.ori * Quaternionr(Matrix3r(central.rotation));
		giveShape(*body, shape, state.blockedDOFs == State::DOF_ALL, isotropyTolerance);
	}

	/// Gives a clump another mass, centre and principal axes than those that YADE sums over its members; the members stay where they are.
	void setClump(const shared_ptr<Body>& body, const Real& mass, const Vector3r& inertia, const Vector3r& centre,
	        const Quaternionr& axes, Real isotropyTolerance)
	{
		auto* const clump = dynamic_cast<Clump*>(body->shape.get());
		if (!clump) throw std::invalid_argument("body: is no clump");
		State& state  = *body->state;
		state.mass    = mass;
		state.inertia = inertia;
		state.pos = state.refPos = centre;
		state.ori = state.refOri = axes;
		const Quaternionr back   = axes.conjugate();
		for (auto& [id, relative] : clump->members) {
			const State& member  = *Body::byId(id)->state;
			relative.position    = back * (member.pos - centre);
			relative.orientation = back * member.ori;
		}
		body->setAspherical(inertia.maxCoeff() - inertia.minCoeff() > isotropyTolerance * inertia.maxCoeff());
	}

	/// (volume, mass, centre, inertia as nine numbers) of what polyhedra fill together, each of the density that its mass gives.
	py::tuple unionOf(const py::object& bodies)
	{
		std::vector<shared_ptr<Body>> given;
		for (py::ssize_t i = 0; i < py::len(bodies); ++i)
			given.push_back(py::extract<shared_ptr<Body>>(bodies[i]));
		std::vector<polytope::UnionPart> parts;
		const Vector3r                   origin = given.at(0)->state->pos; // numbers are small about it
		for (const auto& body : given) {
			const Polytope* const shape = polytopeOf(*body);
			if (!shape || shape->dimension != 3) throw std::invalid_argument("parts: must be polyhedra");
			parts.push_back({ placed(*shape->convex(), *body->state, -origin), body->state->mass / shape->volume() });
		}
		const auto all = polytope::unionOf(parts);
		py::list   tensor;
		for (int k = 0; k < 9; ++k)
			tensor.append(all.inertia(k / 3, k % 3));
		return py::make_tuple(all.volume, all.mass, Vector3r(origin + all.centre), tensor);
	}

} // namespace

void defineConstruction()
{
	py::class_<CentralShape>("CentralShape", "A shape of ShapeFactory, and where it is.", py::no_init)
	        .add_property(
	                "position", +[](const CentralShape& p) { return p.position; }, "Centroid [m].")
	        .add_property("orientation", +[](const CentralShape& p) { return Quaternionr(Matrix3r(p.rotation)); }, "Principal axes.");
	py::def("ofHalfSpaces", &ofHalfSpaces,
	        "Shape of planes: normals, offsets, dimension, thickness, keepRedundant, cornerRadius or None, cornerFraction.");
	py::def("ofPoints", &ofPoints, "Shape of a hull: points, dimension, coplanar, thickness, cornerRadius or None, cornerFraction.");
	py::def("ofRegular", &ofRegular, "Regular polyhedron: faces, circumradius, cornerRadius or None, cornerFraction.");
	py::def("ofCuboid", &ofCuboid, "Rectangular block: half-lengths, cornerRadius or None, cornerFraction.");
	py::def("body", &body, "Body of a CentralShape: shape, material, centre or None, turn, fixed, isotropyTolerance, color or None.");
	py::def("reshape", &reshape, "Gives a body of a Polytope another shape with the same planes: body, shape, isotropyTolerance.");
	py::def("setClump", &setClump, "Mass and principal axes of a clump: body, mass, inertia, centre, axes, isotropyTolerance.");
	py::def("unionOf", &unionOf, "Volume, mass, centre of mass and tensor of inertia (nine numbers) of what polyhedra fill together.");
}

} // namespace yade
