// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/Polytope.hpp"

#include <core/Body.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>

#include <src/shape/ConstructionTolerances.hpp>
#include <src/shape/RoundedSolid.hpp>

#include <boost/make_shared.hpp>

#include <sstream>

#include "host/ExactClass.hpp"

namespace yade {

POLYTOPE_CLASSES((Polytope)(Bo1_Polytope_Aabb));

namespace {

	/// The core takes any radius its formulas allow; a body's must leave an inner particle.
	void requireInnerParticle(const polytope::ConvexShape& shape)
	{
		if (shape.cornerRadius() >= shape.inscribedRadius())
			throw std::invalid_argument(
			        "cornerRadius: must fit inside the body, that is, be smaller than the inscribed ball's radius "
			        + boost::lexical_cast<std::string>(shape.inscribedRadius()) + " m; got "
			        + boost::lexical_cast<std::string>(shape.cornerRadius()));
	}

} // namespace

std::string Polytope::faultOfFrame() const
{
	const polytope::MassProperties mass = massProperties();
	if (mass.centroid.norm() > polytope::construction::bodyFrame * convex_->boundingRadius())
		return "offsets: the body frame's origin must be the centroid, which is at a distance of "
		        + std::to_string(double(mass.centroid.norm())) + " m; use yade.polytope.fromHalfSpaces, which moves it there";
	Real products = 0;
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < i; ++j)
			products = math::max(products, math::abs(mass.inertia(i, j)));
	if (products > polytope::construction::bodyFrame * mass.inertia.trace())
		return "normals: the body frame's axes must be the principal axes of inertia; use yade.polytope.fromHalfSpaces, which "
		       "turns the "
		       "body";
	return "";
}

void Polytope::forgetPlanes()
{
	vector<Vector3r>().swap(normals);
	vector<Real>().swap(offsets);
	string().swap(planesText);
}

void Polytope::postSave(Polytope&) { forgetPlanes(); }

void Polytope::preSave(Polytope&)
{
	normals = unitNormals();
	offsets = planeOffsets();
	if (!planesAsText) return;
	planesText.clear();
	for (size_t i = 0; i < normals.size(); ++i)
		for (const Real& number : { normals[i][0], normals[i][1], normals[i][2], offsets[i] })
			planesText += math::toString(number) + ' ';
}

void Polytope::postLoad(Polytope&)
{
	if (planesAsText && normals.empty()) {
		std::istringstream text(planesText);
		std::string        number[4];
		while (text >> number[0] >> number[1] >> number[2] >> number[3]) {
			normals.emplace_back(
			        math::fromStringReal(number[0]), math::fromStringReal(number[1]), math::fromStringReal(number[2]));
			offsets.push_back(math::fromStringReal(number[3]));
		}
	}
	if (normals.empty() && offsets.empty() && !convex_) return; // Polytope(): the planes are loaded from an archive afterwards
	if (convex_) {                                              // the corner radius is the only attribute that can have changed
		forgetPlanes();
		try {
			adopt(convex_->withCornerRadius(cornerRadius));
		} catch (const std::invalid_argument&) {
			cornerRadius = convex_->cornerRadius();
			throw;
		}
		return;
	}
	polytope::HalfSpaces planes;
	planes.normals   = normals;
	planes.offsets   = offsets;
	planes.dimension = dimension;
	// a repeated plane would count twice in the analytic centre; once built there are none
	adopt(polytope::ConvexShape::shared(polytope::withoutDuplicates(polytope::normalised(planes)), cornerRadius, thickness));
	forgetPlanes();
}

void Polytope::adopt(const std::shared_ptr<const polytope::ConvexShape>& convex)
{
	requireInnerParticle(*convex);
	const auto before = convex_;
	convex_           = convex;
	// dynamics take the body's origin for the centroid and its axes for principal ones; what makes the mass of a derived class may not yet be loaded
	if (!exactly<Polytope>(this)) return;
	if (const std::string fault = faultOfFrame(); !fault.empty()) {
		convex_ = before;
		throw std::invalid_argument(fault);
	}
}

void Polytope::take(const std::shared_ptr<const polytope::ConvexShape>& convex)
{
	adopt(convex);
	cornerRadius = convex->cornerRadius();
	dimension    = convex->dimension();
	thickness    = convex->thickness();
}

shared_ptr<Polytope> Polytope::of(const std::shared_ptr<const polytope::ConvexShape>& convex)
{
	auto shape = boost::make_shared<Polytope>(); // with its counts in one piece of memory
	shape->take(convex);
	return shape;
}

vector<Vector3r> Polytope::unitNormals() const { return convex_ ? convex_->planes().normals : vector<Vector3r>(); }

vector<Real> Polytope::planeOffsets() const { return convex_ ? convex_->planes().offsets : vector<Real>(); }

boost::python::dict Polytope::pyDictCustom() const
{
	boost::python::dict planes;
	planes["normals"] = unitNormals();
	planes["offsets"] = planeOffsets();
	return planes;
}

Real Polytope::volume() const { return massProperties().volume; }

Vector3r Polytope::inertia() const { return massProperties().inertia.diagonal(); }

polytope::MassProperties Polytope::massProperties() const
{
	if (!convex_) return {};
	const Real radius = margin().value_or(0);
	return radius > 0 ? polytope::roundedMass(convex_->polyhedron(), radius) : convex_->mass();
}

std::shared_ptr<const polytope::Polyhedron> Polytope::surface() const
{
	if (!convex_) return nullptr;
	const Real radius = margin().value_or(0);
	if (radius > 0) return std::make_shared<const polytope::Polyhedron>(polytope::roundedSurface(convex_->polyhedron(), radius));
	return { convex_, &convex_->polyhedron() };
}

std::optional<Real> Polytope::margin() const { return exactly<Polytope>(this) ? std::optional<Real>(Real(0)) : std::nullopt; }

vector<Vector3r> Polytope::vertices() const { return convex_ ? convex_->polyhedron().vertices : vector<Vector3r>(); }

Real Polytope::inscribedRadius() const { return convex_ ? convex_->inscribedRadius() : Real(0); }

Real Polytope::circumscribedRadius() const { return convex_ ? convex_->boundingRadius() : Real(0); }

boost::python::list Polytope::faces() const
{
	boost::python::list all;
	if (!convex_) return all;
	for (const auto& face : convex_->polyhedron().faces) {
		boost::python::list one;
		for (int vertex : face)
			one.append(vertex);
		all.append(one);
	}
	return all;
}

bool mayTurn(const Body* body)
{
	if (!body || !body->state || body->isClumpMember()) return true;
	const State& state = *body->state;
	return (state.blockedDOFs & State::DOF_RXRYRZ) != State::DOF_RXRYRZ || state.angVel != Vector3r::Zero();
}

void Bo1_Polytope_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body* body)
{
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	// the collider of a periodic cell works in unsheared coordinates; the map is linear, so the box stays tight
	const Matrix3r unshear = scene->isPeriodic ? scene->cell->getUnshearTrsf() : Matrix3r(Matrix3r::Identity());
	const Matrix3r turn    = unshear * se3.orientation.toRotationMatrix();
	const Vector3r centre  = unshear * se3.position;
	const auto&    convex  = static_cast<const Polytope&>(*shape).convex();
	Vector3r       low = Vector3r::Zero(), high = Vector3r::Zero();
	const Real     any  = std::numeric_limits<Real>::infinity();
	const bool     told = rooms && body && body->id < Body::id_t(rooms->size());
	const Real     room = told ? (*rooms)[body->id] : mayTurn(body) ? any : Real(0);
	// axes along which a rotation moves vertices (a polygon turns about z alone)
	const int turning = convex && room > 0 ? convex->dimension() : 0;
	if (convex && (room < any || turning < 3)) {
		low = high = turn * convex->polyhedron().vertices.front();
		for (const Vector3r& vertex : convex->polyhedron().vertices) {
			const Vector3r moved = turn * vertex;
			low                  = low.cwiseMin(moved);
			high                 = high.cwiseMax(moved);
		}
	}
	for (int k = 0; k < turning; ++k) {
		// the tight box enlarged by that distance, and never larger than the ball's (the disc's)
		const Real stretch = unshear.row(k).head(turning).norm(), ball = convex->boundingRadius() * stretch;
		high[k] = room < any ? math::min(ball, Real(high[k] + room * stretch)) : ball;
		low[k]  = room < any ? math::max(-ball, Real(low[k] - room * stretch)) : -ball;
	}
	if (const std::optional<Real> margin = static_cast<const Polytope&>(*shape).margin(); margin && *margin > 0)
		for (int k = 0; k < 3; ++k) { // of a ball in the cell's coordinates
			low[k] -= *margin * unshear.row(k).norm();
			high[k] += *margin * unshear.row(k).norm();
		}
	bound->min = centre + low;
	bound->max = centre + high;
}

} // namespace yade
