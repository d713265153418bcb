// SPDX-License-Identifier: GPL-2.0-or-later
//
// Sums of stiffness in a run on several processes (py/polytope/mpi): a worker knows all contacts of its own bodies alone, and the dampers
// of a contact need the sums of both of its bodies.
#include "step/WorkerSums.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include "joint/RockJointLaw.hpp"
#include "step/TimeStepLimits.hpp"

#include <boost/python.hpp>

#include <cstring>

namespace py = boost::python;

namespace yade {
#ifdef YADE_MPI // wider precisions have none; their numbers are no plain bytes
namespace {

	StiffnessSums* sumsOfScene()
	{
		const auto* law = dampingLaw(*Omega::instance().getScene());
		return law ? const_cast<StiffnessSums*>(&law->stiffnessSums) : nullptr;
	}

	std::vector<Body::id_t> idsOf(const py::object& list)
	{
		std::vector<Body::id_t> ids;
		for (py::stl_input_iterator<Body::id_t> id(list), end; id != end; ++id)
			ids.push_back(*id);
		return ids;
	}

	/// The step, then a StiffnessSum for each body; nothing in a scene that has no such law.
	py::object bytesOf(const py::object& list)
	{
		const auto* sums = sumsOfScene();
		if (!sums) return py::object(py::handle<>(PyBytes_FromStringAndSize(nullptr, 0)));
		const std::vector<StiffnessSum> of   = sums->of(idsOf(list));
		const long                      step = sums->step();
		const std::size_t               size = of.size() * sizeof(StiffnessSum);
		py::object                      bytes { py::handle<>(PyBytes_FromStringAndSize(nullptr, Py_ssize_t(sizeof step + size))) };
		char* const                     to = PyBytes_AS_STRING(bytes.ptr());
		std::memcpy(to, &step, sizeof step);
		if (size > 0) std::memcpy(to + sizeof step, of.data(), size);
		return bytes;
	}

	void takeBytes(const py::object& list, const py::object& bytes)
	{
		auto* const                   sums = sumsOfScene();
		const std::vector<Body::id_t> ids  = idsOf(list);
		long                          step = 0;
		const std::size_t             size = PyBytes_Check(bytes.ptr()) ? std::size_t(PyBytes_GET_SIZE(bytes.ptr())) : 0;
		if (!sums || size == 0) return;
		if (size != sizeof step + ids.size() * sizeof(StiffnessSum))
			throw std::invalid_argument("bytes: must be those of stiffnessSums() for as many bodies as ids has");
		std::vector<StiffnessSum> of(ids.size());
		const char* const         from = PyBytes_AS_STRING(bytes.ptr());
		std::memcpy(&step, from, sizeof step);
		if (!of.empty()) std::memcpy(static_cast<void*>(of.data()), from + sizeof step, size - sizeof step);
		sums->take(ids, of, step);
	}

} // namespace

void defineWorkerSums()
{
	py::def("stiffnessSums", &bytesOf, py::arg("ids"),
	        "What contacts these bodies have, as dampers know it, from the newest step; bytes, used by yade.polytope.mpi.");
	py::def("takeStiffnessSums", &takeBytes, (py::arg("ids"), py::arg("bytes")), "Puts it in place of what this process has of them.");
}
#else
void defineWorkerSums() { }
#endif

} // namespace yade
