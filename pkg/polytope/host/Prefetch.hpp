// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include <omp.h>

/// Prefetches into the cache the data of the InteractionLoop's next pairs, while the present pair is computed.
///
/// A settled heap's pairs are in the loop in the order in which they were created and deleted, so each brings a kilobyte and a half from
/// random places in memory; with more than a few thousand bodies this latency costs more than the contact itself. What a pair refers to is
/// known a few pairs before its turn: first where it is, then the pair itself, then where its bodies are, then what it points to, then what its bodies
/// point to.
namespace yade {

namespace prefetch {

	/// How many pairs ahead. The gaps let each address arrive before it is followed; how long they are matters little.
	constexpr int place = 16, pair = 8, bodyPlaces = 6, parts = 4, bodyParts = 2;

	/// Bytes of a contact's physics that are fetched: what is read in each step. Where the physics of joints are defined, it is checked that
	/// they keep to this.
	constexpr std::size_t physicsBytes = 60 * sizeof(Real);

	/// Does not read at that address: another thread may be deleting the pair's geometry.
	inline void fetch(const void* object, std::size_t bytes)
	{
		if (!object) return;
		constexpr std::size_t line  = 64;
		const auto* const     begin = static_cast<const char*>(object);
		for (std::size_t at = 0; at < bytes; at += line)
			__builtin_prefetch(begin + at);
		__builtin_prefetch(begin + bytes - 1);
	}

	/// The loop's pair so many places after this one; null at the loop's end, and of a pair outside it.
	inline const Interaction* after(const Interaction& now, const Scene& scene, int ahead)
	{
		InteractionContainer& pairs = *scene.interactions;
		const std::size_t     index = std::size_t(now.linIx) + std::size_t(ahead);
		return now.linIx >= 0 && index < pairs.size() ? pairs[index].get() : nullptr;
	}

	/// The same as far as what its geometry and its physics point to can be read, for they have arrived and no other thread deletes them: the pair that is
	/// computed itself where there are other threads.
	inline const Interaction* readable(const Interaction& now, const Scene& scene)
	{
		return omp_get_num_threads() == 1 ? after(now, scene, bodyParts) : &now;
	}

} // namespace prefetch

/// To be called from a functor's go(), with the sizes of the geometry and the shape that it is for. Bodies and the list of pairs stay as
/// they are while the loop runs; other shapes and geometries than ours are smaller.
inline void prefetchAfter(const Interaction& now, const Scene& scene, std::size_t geometryBytes, std::size_t shapeBytes)
{
	if (now.linIx < 0) return;
	InteractionContainer& pairs = *scene.interactions;
	const std::size_t     place = std::size_t(now.linIx) + prefetch::place;
	if (place < pairs.size()) prefetch::fetch(&pairs[place], sizeof(shared_ptr<Interaction>));
	if (const Interaction* next = prefetch::after(now, scene, prefetch::pair)) prefetch::fetch(next, sizeof(Interaction));
	if (const Interaction* next = prefetch::after(now, scene, prefetch::bodyPlaces)) {
		for (const Body::id_t id : { next->getId1(), next->getId2() })
			prefetch::fetch(&(*scene.bodies)[id], sizeof(shared_ptr<Body>));
	}
	if (const Interaction* next = prefetch::after(now, scene, prefetch::parts)) {
		prefetch::fetch(next->geom.get(), geometryBytes);
		prefetch::fetch(next->phys.get(), prefetch::physicsBytes);
		for (const Body::id_t id : { next->getId1(), next->getId2() })
			prefetch::fetch((*scene.bodies)[id].get(), sizeof(Body));
	}
	if (const Interaction* next = prefetch::after(now, scene, prefetch::bodyParts)) {
		for (const Body::id_t id : { next->getId1(), next->getId2() })
			if (const Body* body = (*scene.bodies)[id].get()) {
				prefetch::fetch(body->state.get(), sizeof(State));
				prefetch::fetch(body->shape.get(), shapeBytes);
			}
	}
}

} // namespace yade
