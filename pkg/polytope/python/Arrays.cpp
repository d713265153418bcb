// SPDX-License-Identifier: GPL-2.0-or-later
#include "python/Arrays.hpp"

#include "host/Prefetch.hpp"
#include "python/ArrayTable.hpp"

#include <core/Body.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <map>

namespace py = boost::python;

namespace yade {
namespace {

	using namespace arrays;

	/// Replaces the class indices in `shapes` by numbers of the classes in the order in which they are met, -1 for no shape; \returns their names.
	py::tuple numberShapes(const std::vector<const Body*>& bodies, int* shapes)
	{
		std::map<int, int> codes;
		py::list           names;
		for (std::size_t row = 0; row < bodies.size(); ++row) {
			if (shapes[row] < 0) continue;
			const auto found = codes.emplace(shapes[row], int(codes.size()));
			if (found.second) names.append(bodies[row]->shape->getClassName());
			shapes[row] = found.first->second;
		}
		return py::tuple(names);
	}

	std::vector<const Body*> bodiesOf(const Scene& scene)
	{
		std::vector<const Body*> bodies;
		bodies.reserve(scene.bodies->size());
		for (std::size_t k = 0; k < scene.bodies->size(); ++k) {
			if (k + ahead < scene.bodies->size()) prefetch::fetch((*scene.bodies)[Body::id_t(k + ahead)].get(), sizeof(Body));
			const auto& body = (*scene.bodies)[Body::id_t(k)];
			if (body && !body->getIsSubdomain()) bodies.push_back(body.get()); // those stand for ranks (docs/mpi.md)
		}
		return bodies;
	}

	/// \returns (columns, names of the shapes' classes)
	py::tuple bodyColumns()
	{
		Scene* const                   scene  = Omega::instance().getScene().get();
		const std::vector<const Body*> bodies = bodiesOf(*scene);
		scene->forces.sync();

		Table       table(bodies.size());
		auto* const ids               = table.column<int>("ids");
		auto* const shapes            = table.column<int>("shapes");
		auto* const clumpIds          = table.column<int>("clumpIds");
		auto* const masks             = table.column<int>("masks");
		auto* const masses            = table.column<double>("masses");
		auto* const positions         = table.column<double>("positions", 3);
		auto* const orientations      = table.column<double>("orientations", 4);
		auto* const velocities        = table.column<double>("velocities", 3);
		auto* const angularVelocities = table.column<double>("angularVelocities", 3);
		auto* const forces            = table.column<double>("forces", 3);
		auto* const torques           = table.column<double>("torques", 3);
#pragma omp parallel for schedule(static)
		for (std::size_t row = 0; row < bodies.size(); ++row) {
			if (row + 2 * ahead < bodies.size()) prefetch::fetch(bodies[row + 2 * ahead], sizeof(Body));
			if (row + ahead < bodies.size()) {
				prefetch::fetch(bodies[row + ahead]->state.get(), sizeof(State));
				prefetch::fetch(bodies[row + ahead]->shape.get(), sizeof(void*)); // its class
			}
			const Body&  body  = *bodies[row];
			const State& state = *body.state;
			ids[row]           = body.getId();
			shapes[row]        = body.shape ? body.shape->getClassIndex() : -1;
			clumpIds[row]      = body.clumpId;
			masks[row]         = int(body.groupMask);
			masses[row]        = double(state.mass);
			put(positions, row, state.pos);
			for (int k = 0; k < 4; ++k)
				orientations[4 * row + std::size_t(k)] = double(state.ori.coeffs()[k]);
			put(velocities, row, state.vel);
			put(angularVelocities, row, state.angVel);
			put(forces, row, scene->forces.getForce(body.getId()));
			put(torques, row, scene->forces.getTorque(body.getId()));
		}
		const py::tuple names = numberShapes(bodies, shapes);
		return py::make_tuple(table.columns(), names);
	}

} // namespace

void defineArrays()
{
	py::def("bodyColumns", &bodyColumns,
	        "Columns of all bodies that are there, name → (bytes, type, numbers per row), and the names of their shapes' classes.");
	py::def("contactColumns", &contactColumns, "The same of all real interactions, and the names of the statuses.");
}

} // namespace yade
