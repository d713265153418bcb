// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contacts between two ranks of a run on several processes (py/polytope/mpi.py).
//
// When yade.mpy divides a scene, each worker deletes the bodies of all other ranks, gets those back that are near its own, and searches for
// contacts anew. So the contacts between two ranks, and all contacts with fixed bodies, which are with rank 0, begin without the shear
// force, slip and strength that they had. A worker takes these contacts from the whole scene before, and puts them back afterwards. When a
// body changes ranks, its former rank sends the body's contacts to the new one, which may not know the other bodies yet.
#include "WorkerContacts.hpp"

#include <lib/serialization/ObjectIO.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <boost/python.hpp>

#include <set>
#include <sstream>

namespace py = boost::python;

namespace yade {
namespace {

	class WorkerContacts {
	public:
		/// Takes the pairs with a geometry of which one body is this rank's, and one is not.
		static WorkerContacts ofBorders()
		{
			const Scene& scene = *Omega::instance().getScene();
			return WorkerContacts([&](const Body& body1, const Body& body2) {
				return (body1.subdomain == scene.subdomain) != (body2.subdomain == scene.subdomain);
			});
		}

		/// Takes the pairs with a geometry of which a body is among these.
		static WorkerContacts ofBodies(const py::list& ids)
		{
			std::set<Body::id_t> wanted;
			for (long k = 0; k < py::len(ids); ++k)
				wanted.insert(py::extract<Body::id_t>(ids[k])());
			return WorkerContacts([&](const Body& body1, const Body& body2) { return wanted.count(body1.id) || wanted.count(body2.id); });
		}

		/// From what bytes() of another rank has returned.
		static WorkerContacts fromBytes(const py::object& bytes)
		{
			char*      begin  = nullptr;
			Py_ssize_t length = 0;
			if (PyBytes_AsStringAndSize(bytes.ptr(), &begin, &length) != 0) py::throw_error_already_set();
			std::istringstream in(std::string(begin, std::size_t(length)));
			WorkerContacts     made;
			ObjectIO::load<Pairs, boost::archive::binary_iarchive>(in, "contacts", made.pairs_);
			return made;
		}

		py::object bytes() const
		{
			std::ostringstream out;
			ObjectIO::save<const Pairs, boost::archive::binary_oarchive>(out, "contacts", pairs_);
			const std::string all = out.str();
			return py::object(py::handle<>(PyBytes_FromStringAndSize(all.data(), Py_ssize_t(all.size()))));
		}

		/// Puts them in place of those found since, where both bodies are here and one of them is this rank's.
		long put()
		{
			Scene& scene = *Omega::instance().getScene();
			long   count = 0;
			for (auto& pair : pairs_) {
				const auto body1 = Body::byId(pair->getId1()), body2 = Body::byId(pair->getId2());
				if (!body1 || !body2 || (body1->subdomain != scene.subdomain && body2->subdomain != scene.subdomain)) continue;
				scene.interactions->insertInteractionMPI(pair);
				++count;
			}
			pairs_.clear();
			return count;
		}

	private:
		using Pairs = std::vector<shared_ptr<Interaction>>;

		WorkerContacts() = default;

		template <class Wanted> explicit WorkerContacts(const Wanted& wanted)
		{
			for (const auto& pair : *Omega::instance().getScene()->interactions) {
				if (!pair || !pair->geom) continue;
				const auto body1 = Body::byId(pair->getId1()), body2 = Body::byId(pair->getId2());
				if (!body1 || !body2 || !wanted(*body1, *body2)) continue;
				// deleting a body empties its pairs
				const auto copy    = boost::make_shared<Interaction>(pair->getId1(), pair->getId2());
				copy->geom         = pair->geom;
				copy->phys         = pair->phys;
				copy->cellDist     = pair->cellDist;
				copy->isActive     = pair->isActive;
				copy->iterMadeReal = pair->iterMadeReal;
				copy->iterBorn     = pair->iterBorn;
				pairs_.push_back(copy);
			}
		}

		Pairs pairs_;
	};

} // namespace

void defineWorkerContacts()
{
	py::class_<WorkerContacts>("WorkerContacts", "Contacts that are handed over when bodies change ranks; used by yade.polytope.mpi.", py::no_init)
	        .def("ofBorders", &WorkerContacts::ofBorders, "Contacts of this rank's bodies with those of other ranks, as they are now.")
	        .staticmethod("ofBorders")
	        .def("ofBodies", &WorkerContacts::ofBodies, "Contacts of the bodies with these ids, as they are now.")
	        .staticmethod("ofBodies")
	        .def("fromBytes", &WorkerContacts::fromBytes, "What bytes() of another rank has returned.")
	        .staticmethod("fromBytes")
	        .def("bytes", &WorkerContacts::bytes, "All that is saved of them.")
	        .def("put", &WorkerContacts::put, "Puts them back where both bodies are here and one is this rank's; returns how many.");
}

} // namespace yade
