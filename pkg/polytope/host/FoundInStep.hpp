// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include <atomic>

/// What functors look for among the engines of their scene while contacts are computed in parallel.
namespace yade {

/// Counts the objects of a kind that were made and destroyed so far, in all scenes.
template <class Kind> class Counted {
public:
	static std::atomic<long>& changes()
	{
		static std::atomic<long> count { 0 };
		return count;
	}

protected:
	Counted() { ++changes(); }
	~Counted() { ++changes(); }
	Counted(const Counted&)            = delete;
	Counted& operator=(const Counted&) = delete;
};

/// What Kind::of(scene) finds, looked for once a step by whichever thread comes first, and anew when an object of this kind, which is Counted, was
/// made or destroyed: what it returns is never one that is gone.
template <class Kind> class FoundInStep {
public:
	const Kind* in(const Scene& scene)
	{
		const long changes = Counted<Kind>::changes().load(std::memory_order_relaxed);
		if (changes == 0) return nullptr; // there never was one
		if (step_.load(std::memory_order_acquire) != scene.iter || changes_.load(std::memory_order_relaxed) != changes) {
			found_.store(Kind::of(scene), std::memory_order_relaxed);
			changes_.store(changes, std::memory_order_relaxed);
			step_.store(scene.iter, std::memory_order_release);
		}
		return found_.load(std::memory_order_relaxed);
	}

private:
	std::atomic<long>        step_ { -1 }, changes_ { 0 };
	std::atomic<const Kind*> found_ { nullptr };
};

} // namespace yade
