// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/BodyContainer.hpp>
#include <core/Scene.hpp>

#include <atomic>
#include <mutex>

namespace yade {

/// Whether bodies were added or erased between two steps, for functors whose contacts depend on other bodies than their own two. Only the number is
/// compared, as YADE keeps it (BodyContainer.enableRedirection, its default): as many added as erased are not noticed.
class ChangeOfBodies {
public:
	/// Since the last step in which this was asked; found by whichever thread comes first.
	bool in(const Scene& scene)
	{
		if (step_.load(std::memory_order_acquire) != scene.iter) {
			const std::lock_guard<std::mutex> lock(mutex_);
			if (step_.load(std::memory_order_relaxed) != scene.iter) {
				const long number = long(scene.bodies->realBodies.size());
				changed_.store(number_ >= 0 && number != number_, std::memory_order_relaxed);
				number_ = number;
				step_.store(scene.iter, std::memory_order_release);
			}
		}
		return changed_.load(std::memory_order_relaxed);
	}

private:
	std::atomic<long> step_ { -1 };
	std::atomic<bool> changed_ { false };
	std::mutex        mutex_;
	long              number_ = -1; ///< of bodies; negative: not asked yet
};

} // namespace yade
