// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/StiffnessSums.hpp"

#include <omp.h>

#include <algorithm>

namespace yade {

void StiffnessSums::beginStep(const Scene& scene)
{
	const std::lock_guard<std::mutex> lock(beginning_);
	if (begun_.load(std::memory_order_relaxed) == scene.iter) return; // another thread has done it
	lastKnown_ = step_ == scene.iter - 1;
	std::swap(last_, newest_);
	newest_.resize(scene.bodies->size());
	std::fill(newest_.begin(), newest_.end(), StiffnessSum());
	step_ = scene.iter;
	begun_.store(scene.iter, std::memory_order_release);
}

void StiffnessSums::add(Body::id_t body, Across across, Real stiffness, const Vector3r& n)
{
	if (body < 0 || std::size_t(body) >= newest_.size()) return;
	auto&      sum   = newest_[std::size_t(body)].value[std::size_t(across)];
	const Real of[6] = { n[0] * n[0], n[1] * n[1], n[2] * n[2], n[1] * n[2], n[2] * n[0], n[0] * n[1] };
	if (omp_get_num_threads() == 1) {
		for (std::size_t k = 0; k < 6; ++k)
			sum[k] += stiffness * of[k];
		return;
	}
	for (std::size_t k = 0; k < 6; ++k) {
		const Real part = stiffness * of[k];
#if YADE_REAL_BIT <= 64
#pragma omp atomic
		sum[k] += part;
#else // no atomic operation has numbers that long
#pragma omp critical(polytopeStiffnessSums)
		sum[k] += part;
#endif
	}
}

std::vector<StiffnessSum> StiffnessSums::of(const std::vector<Body::id_t>& bodies) const
{
	std::vector<StiffnessSum> sums(bodies.size());
	for (std::size_t k = 0; k < bodies.size(); ++k)
		sums[k] = newest(bodies[k]);
	return sums;
}

void StiffnessSums::take(const std::vector<Body::id_t>& bodies, const std::vector<StiffnessSum>& sums, long step)
{
	if (step > step_) {
		std::fill(newest_.begin(), newest_.end(), StiffnessSum());
		step_ = step;
	}
	for (std::size_t k = 0; k < bodies.size(); ++k) {
		if (bodies[k] < 0) continue;
		if (newest_.size() <= std::size_t(bodies[k])) newest_.resize(std::size_t(bodies[k]) + 1);
		newest_[std::size_t(bodies[k])] = step < step_ ? StiffnessSum() : sums[k];
	}
}

} // namespace yade
