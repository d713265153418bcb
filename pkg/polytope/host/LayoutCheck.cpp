// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/LayoutCheck.hpp"
#include "BuildInfo.hpp"

#include <core/Aabb.hpp>
#include <core/Cell.hpp>
#include <core/Clump.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionLoop.hpp>
#include <core/Scene.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/InsertionSortCollider.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <malloc.h>
#include <string>

namespace yade {
namespace {

	/// Reports of the differences found, a line each.
	std::string faults;

	template <class Class> shared_ptr<Class> madeByYade(const char* name)
	{
		const shared_ptr<Factorable> object = ClassFactory::instance().createShared(name);
		const std::size_t            block  = malloc_usable_size(dynamic_cast<void*>(object.get()));
		// malloc rounds a block up to a multiple of 16 bytes, less the 8 of its own header
		if (block < sizeof(Class) || block > sizeof(Class) + 24) {
			faults += std::string("\t") + name + " takes " + std::to_string(sizeof(Class)) + " bytes in the plug-in, about "
			        + std::to_string(block) + " in YADE\n";
			return nullptr;
		}
		return boost::static_pointer_cast<Class>(object);
	}

	template <class Class, class Base, class Value>
	void compare(const char* name, Class& object, const char* attribute, Value Base::* member)
	{
		const Value old  = object.*member;
		const Value sent = static_cast<Value>(!old); // 0 or 1, and never the old value
		object.pySetAttr(attribute, boost::python::object(sent));
		if (object.*member != sent) faults += std::string("\t") + name + "::" + attribute + " lies elsewhere in YADE\n";
		object.pySetAttr(attribute, boost::python::object(old));
	}

	template <class Class, class... Members> void check(const char* name, Members... members)
	{
		const shared_ptr<Class> object = madeByYade<Class>(name);
		if (object) (compare(name, *object, members.first, members.second), ...);
	}

	template <class Base, class Value> std::pair<const char*, Value Base::*> member(const char* name, Value Base::* pointer)
	{
		return { name, pointer };
	}

	void compareAll()
	{
#if YADE_REAL_BIT > 64
		boost::python::import("yade._minieigenHP"); // Real's converters to Python; for double Boost.Python has them
#endif
		check<Scene>("Scene", member("dt", &Scene::dt), member("iter", &Scene::iter), member("subStep", &Scene::subStep),
		        member("time", &Scene::time), member("stopAtTime", &Scene::stopAtTime), member("isPeriodic", &Scene::isPeriodic),
		        member("selectedBody", &Scene::selectedBody));
		check<Body>("Body", member("id", &Body::id), member("flags", &Body::flags), member("clumpId", &Body::clumpId),
		        member("iterBorn", &Body::iterBorn), member("timeBorn", &Body::timeBorn));
		check<State>("State", member("mass", &State::mass), member("isDamped", &State::isDamped),
		        member("densityScaling", &State::densityScaling));
		check<Shape>("Shape", member("wire", &Shape::wire), member("highlight", &Shape::highlight));
		check<Aabb>("Aabb", member("lastUpdateIter", &Aabb::lastUpdateIter), member("sweepLength", &Aabb::sweepLength));
		check<Cell>("Cell", member("homoDeform", &Cell::homoDeform), member("flipFlippable", &Cell::flipFlippable));
		check<Interaction>("Interaction", member("id1", &Interaction::id1), member("iterMadeReal", &Interaction::iterMadeReal),
		        member("linIx", &Interaction::linIx), member("iterBorn", &Interaction::iterBorn));
		check<FrictMat>("FrictMat", member("id", &FrictMat::id), member("density", &FrictMat::density),
		        member("young", &FrictMat::young), member("frictionAngle", &FrictMat::frictionAngle));
		check<FrictPhys>("FrictPhys", member("kn", &FrictPhys::kn), member("ks", &FrictPhys::ks),
		        member("tangensOfFrictionAngle", &FrictPhys::tangensOfFrictionAngle));
		check<ScGeom>("ScGeom", member("refR1", &ScGeom::refR1), member("refR2", &ScGeom::refR2),
		        member("penetrationDepth", &ScGeom::penetrationDepth));
		check<InsertionSortCollider>("InsertionSortCollider", member("dead", &InsertionSortCollider::dead),
		        member("sortAxis", &InsertionSortCollider::sortAxis), member("numAction", &InsertionSortCollider::numAction),
		        member("smartInsertErase", &InsertionSortCollider::smartInsertErase));
		check<InteractionLoop>(
		        "InteractionLoop", member("dead", &InteractionLoop::dead), member("ompThreads", &InteractionLoop::ompThreads));
	}

	shared_ptr<Factorable> refuse()
	{
		const std::string text = "The plug-in yade-polytope does not fit this YADE, although version and features agree:\n" + faults
		        + "It was compiled with other settings than YADE. " + polytope::buildInfo::remedy;
		PyErr_SetString(PyExc_ImportError, text.c_str());
		boost::python::throw_error_already_set();
		return nullptr;
	}

} // namespace
} // namespace yade

void polytopeCheckLayout()
{
	using namespace yade;
	try {
		compareAll();
	} catch (const boost::python::error_already_set&) {
		PyErr_Clear();
		faults += "\ta member could not be set by its name\n";
	} catch (const std::exception& error) {
		faults += std::string("\t") + error.what() + "\n";
	}
	if (faults.empty()) return;
	// After all libraries are loaded YADE makes one object of each class, in the order of their names; an exception that is
	// no std::runtime_error ends that and goes to Python. '!' comes before all letters.
	const char* const name = "!polytopeRefused";
	ClassFactory::instance().registerFactorable(name, nullptr, &refuse, nullptr);
	ClassFactory::instance().pluginClasses.push_back(name);
}
