// SPDX-License-Identifier: GPL-2.0-or-later
//
// Included before everything else in each file of the plug-in (CMakeLists.txt), so that files compile fast.
//
// A header of a class of YADE's ends with REGISTER_SERIALIZABLE, which makes every file that includes it register the class and so compile its
// constructor and its side of Python: most of what the compiler does in a file that has nothing of the sort in it. ClassFactory takes the first
// registration and no other. Here a class of ours is registered in the file of its POLYTOPE_CLASSES alone, and one of YADE's by YADE alone.
#pragma once

#include <lib/factory/ClassFactory.hpp>

#undef REGISTER_FACTORABLE
#define REGISTER_FACTORABLE(name)

#define POLYTOPE_REGISTER(name)                                                                                                            \
	const bool known##name __attribute__((unused)) = ClassFactory::instance().registerFactorable(                                      \
	        #name, []() -> Factorable* { return new name; }, []() -> shared_ptr<Factorable> { return shared_ptr<name>(new name); },    \
	        []() -> void* { return new name; });
#define POLYTOPE_REGISTER_EACH(x, y, name) POLYTOPE_REGISTER(name) // the name is expanded on the way

/// YADE_PLUGIN, and the registration: POLYTOPE_CLASSES((One)(Another)); in namespace yade.
#define POLYTOPE_CLASSES(classes)                                                                                                          \
	namespace {                                                                                                                        \
	BOOST_PP_SEQ_FOR_EACH(POLYTOPE_REGISTER_EACH, ~, classes)                                                                          \
	}                                                                                                                                  \
	YADE_PLUGIN(classes)
