// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contacts between two ranks of a run on several processes (py/polytope/mpi).
//
// When yade.mpy divides a scene, each worker deletes the bodies of all other ranks, gets those back that are near its own, and searches for
// contacts anew. So the contacts between two ranks, and all contacts with fixed bodies, which are with rank 0, begin without the shear
// force, slip and strength that they had. A worker takes these contacts from the whole scene before, and puts them back afterwards. Later searches
// would delete the bodies of open joints: their ids are what a worker asks the others for.
#include "step/WorkerContacts.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <boost/python.hpp>

#include <set>

namespace py = boost::python;

namespace yade {
#ifdef YADE_MPI // Debian's builds of wider precisions have none, and no yade.mpy
namespace {

	class WorkerContacts {
	public:
		/// Takes the pairs with a geometry of which one body is this rank's, and one is not.
		WorkerContacts()
		{
			const Scene& scene = *Omega::instance().getScene();
			for (const auto& pair : *scene.interactions) {
				if (!pair || !pair->geom) continue;
				const auto body1 = Body::byId(pair->getId1()), body2 = Body::byId(pair->getId2());
				if (!body1 || !body2 || (body1->subdomain == scene.subdomain) == (body2->subdomain == scene.subdomain))
					continue;
				// deleting a body empties its pairs
				const auto copy    = boost::make_shared<Interaction>(pair->getId1(), pair->getId2());
				copy->geom         = pair->geom;
				copy->phys         = pair->phys;
				copy->cellDist     = pair->cellDist;
				copy->isActive     = pair->isActive;
				copy->iterMadeReal = pair->iterMadeReal;
				copy->iterBorn     = pair->iterBorn;
				pairs_.push_back(copy);
				partners_.insert(body1->subdomain == scene.subdomain ? pair->getId2() : pair->getId1());
			}
		}

		py::list partners() const
		{
			py::list ids;
			for (const Body::id_t id : partners_)
				ids.append(id);
			return ids;
		}

		/// Puts them in place of those found since, where both bodies are here.
		long put()
		{
			Scene& scene = *Omega::instance().getScene();
			long   count = 0;
			for (auto& pair : pairs_) {
				if (!Body::byId(pair->getId1()) || !Body::byId(pair->getId2())) continue;
				scene.interactions->insertInteractionMPI(pair);
				++count;
			}
			pairs_.clear();
			return count;
		}

	private:
		std::vector<shared_ptr<Interaction>> pairs_;
		std::set<Body::id_t>                 partners_; ///< of other ranks
	};

} // namespace

void defineWorkerContacts()
{
	py::class_<WorkerContacts>("WorkerContacts",
	        "Contacts of this rank's bodies with those of other ranks, as they are when the object is made; used by yade.polytope.mpi.")
	        .def("partners", &WorkerContacts::partners, "Ids of the bodies of other ranks, ascending.")
	        .def("put", &WorkerContacts::put, "Puts them back where both bodies are here; returns how many.");
}
#else
void defineWorkerContacts() { }
#endif

} // namespace yade
