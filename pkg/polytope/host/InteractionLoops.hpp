// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/InteractionLoop.hpp>
#include <core/Scene.hpp>

#include <utility>

/// What a scene's engines say of its contacts: its interaction loops, and the functors in them.
namespace yade {

/// The first thing (a pointer that is not null, an optional with a value) that find(loop) returns for the scene's loops, in the order of its engines.
template <class Find> auto findInLoops(const Scene& scene, const Find& find) -> decltype(find(std::declval<InteractionLoop&>()))
{
	for (const auto& engine : scene.engines)
		if (auto* const loop = dynamic_cast<InteractionLoop*>(engine.get()))
			if (auto found = find(*loop)) return found;
	return {};
}

/// The first thing that find(functor) returns for the functors of a kind in one of the loops' dispatchers, as &InteractionLoop::physDispatcher.
template <class Kind, class Dispatcher, class Find>
auto findInFunctors(const Scene& scene, shared_ptr<Dispatcher> InteractionLoop::* dispatcher, const Find& find)
        -> decltype(find(std::declval<Kind&>()))
{
	return findInLoops(scene, [&](InteractionLoop& loop) -> decltype(find(std::declval<Kind&>())) {
		for (const auto& functor : (loop.*dispatcher)->functors)
			if (auto* const one = dynamic_cast<Kind*>(functor.get()))
				if (auto found = find(*one)) return found;
		return {};
	});
}

/// The first functor of a kind; null where there is none.
template <class Kind, class Dispatcher> Kind* firstFunctor(const Scene& scene, shared_ptr<Dispatcher> InteractionLoop::* dispatcher)
{
	return findInFunctors<Kind>(scene, dispatcher, [](Kind& functor) { return &functor; });
}

} // namespace yade
