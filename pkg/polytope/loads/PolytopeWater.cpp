// SPDX-License-Identifier: GPL-2.0-or-later
#include "loads/PolytopeWater.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>

#include "host/PartsOfBodies.hpp"
#include "shape/ShapeOfBody.hpp"

#include <algorithm>

namespace yade {

POLYTOPE_CLASSES((PolytopeWater));

namespace {

	/// Whether this rank loads the body: in a divided scene each rank loads its own bodies, and hands their forces on; otherwise all bodies are loaded.
	bool isOwn(const Body& body, const Scene& scene)
	{
#ifdef YADE_MPI
		return body.subdomain == scene.subdomain;
#else
		(void)body, (void)scene;
		return true;
#endif
	}

	void mustHold(bool good, const char* name, const char* rule)
	{
		if (!good) throw std::invalid_argument(std::string(name) + ": " + rule);
	}

	bool hasNumbers(const Vector3r& v) { return math::isfinite(v[0]) && math::isfinite(v[1]) && math::isfinite(v[2]); }

} // namespace

void PolytopeWater::postLoad(PolytopeWater&)
{
	const std::size_t count = points.size(), most = polytope::PressurePiece::mostSides;
	mustHold(values.size() == count, "values", "must be as many as points");
	mustHold(gradients.size() == count, "gradients", "must be as many as points");
	mustHold(sides.size() == most * count, "sides", "must be three for each of the points; zero vectors bound nothing");
	mustHold(sideOffsets.size() == sides.size(), "sideOffsets", "must be as many as sides");
	mustHold(wetPlanes.size() == wetBodies.size(), "wetPlanes", "must be as many as wetBodies");
	std::vector<polytope::PressurePiece> pieces(count);
	for (std::size_t k = 0; k < count; ++k) {
		mustHold(hasNumbers(points[k]) && hasNumbers(gradients[k]) && math::isfinite(values[k]), "points, values, gradients",
		        "must be finite");
		polytope::PressurePiece& piece = pieces[k];
		piece.point                    = points[k];
		piece.gradient                 = gradients[k];
		piece.value                    = values[k];
		for (std::size_t side = most * k; side < most * (k + 1); ++side)
			if (sides[side] != Vector3r(Vector3r::Zero())) piece.sides[piece.sideCount++] = { sides[side], sideOffsets[side] };
	}
	std::vector<std::vector<int>> wet;
	for (std::size_t k = 0; k < wetBodies.size(); ++k) {
		mustHold(wetBodies[k] >= 0, "wetBodies", "must be ids of bodies");
		if (wet.size() <= std::size_t(wetBodies[k])) wet.resize(std::size_t(wetBodies[k]) + 1);
		wet[std::size_t(wetBodies[k])].push_back(wetPlanes[k]);
	}
	for (std::vector<int>& planes : wet)
		std::sort(planes.begin(), planes.end());
	pieces_.swap(pieces);
	wet_.swap(wet);
}

polytope::WaterLoad PolytopeWater::loadOn(const Body& body, polytope::ClippedFace& memory) const
{
	const polytope::ConvexShape* const shape = convexShapeOf(body);
	const std::size_t                  id    = std::size_t(body.id);
	if (!shape || (someFaces && (id >= wet_.size() || wet_[id].empty()))) return polytope::WaterLoad();
	return polytope::waterLoad(placed(*shape, *body.state), pieces_, someFaces ? &wet_[id] : nullptr, memory);
}

void PolytopeWater::action()
{
	std::size_t vertices = 0;
	for (const auto& body : *scene->bodies)
		if (const polytope::ConvexShape* shape = body ? convexShapeOf(*body) : nullptr)
			vertices = math::max(vertices, shape->polyhedron().vertices.size());
	memory_.resize(std::size_t(math::max(1, omp_get_max_threads())));
	for (polytope::ClippedFace& memory : memory_)
		memory.holdFaceOf(vertices);
	const long count = long(scene->bodies->size());
#pragma omp parallel for schedule(static)
	for (long id = 0; id < count; ++id) {
		const auto& body = (*scene->bodies)[Body::id_t(id)];
		if (!body || !isOwn(*body, *scene)) continue;
		const polytope::WaterLoad found = loadOn(*body, memory_[std::size_t(omp_get_thread_num())]);
		if (found.force == Vector3r(Vector3r::Zero()) && found.torque == Vector3r(Vector3r::Zero())) continue;
		scene->forces.addForce(Body::id_t(id), found.force);
		scene->forces.addTorque(Body::id_t(id), found.torque);
	}
}

boost::python::tuple PolytopeWater::load(int id) const
{
	const Scene& where = *Omega::instance().getScene();
	if (id < 0 || !where.bodies->exists(Body::id_t(id))) throw std::invalid_argument("id: there is no body " + std::to_string(id));
	const Body& body = *(*where.bodies)[Body::id_t(id)];
	if (!body.isClump() && !convexShapeOf(body))
		throw std::invalid_argument("id: body " + std::to_string(id) + " has no Polytope shape");
	polytope::ClippedFace memory;
	polytope::WaterLoad   found;
	if (dead) return boost::python::make_tuple(Vector3r(found.force), Vector3r(found.torque));
	forParts(body, where, [&](const Body& part) {
		const polytope::WaterLoad one = loadOn(part, memory);
		found.force += one.force;
		found.torque += one.torque + (part.state->pos - body.state->pos).cross(one.force);
	});
	return boost::python::make_tuple(Vector3r(found.force), Vector3r(found.torque));
}

} // namespace yade
