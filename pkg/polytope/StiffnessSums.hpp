// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <boost/serialization/level.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/tracking.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <vector>

namespace yade {

/// A symmetric matrix: xx, yy, zz, yz, zx, xy.
struct StiffnessSum {
	std::array<Real, 6> value { { 0, 0, 0, 0, 0, 0 } };

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		for (Real& one : value)
			archive& boost::serialization::make_nvp("value", one);
	}
};

/// Σ kₙ n nᵀ over the contacts of each body (of a clump: of its members), by the body's id.
///
/// A damper that is to be critical for a body has to know what else carries it. The contacts of a step are computed one after the other, by several
/// threads, so that the sum of this step is not known yet: each contact reads the sum of the last step, and adds to that of this one. Between two steps
/// the newest sum is whole; archives have it, so that a run which is loaded goes on as if it had not been interrupted.
class StiffnessSums {
public:
	StiffnessSums() = default;
	StiffnessSums(const StiffnessSums& other) : step_(other.step_), newest_(other.newest_) { }
	StiffnessSums& operator=(const StiffnessSums& other)
	{
		step_   = other.step_;
		newest_ = other.newest_;
		begun_  = -1;
		return *this;
	}

	/// Before a contact reads or adds: the first one of a step begins a new sum. Allocates where bodies were added.
	void begin(const Scene& scene)
	{
		if (begun_.load(std::memory_order_acquire) != scene.iter) beginStep(scene);
	}
	/// Whether there is a sum of the last step. Not where nothing was damped in it, or the law is a new one.
	bool lastKnown() const { return lastKnown_; }
	/// nᵀ (Σ k n nᵀ) n of the last step [N/m].
	Real last(Body::id_t body, const Vector3r& normal) const { return along(last_, body, normal); }
	/// The same of the newest step; for use between two loops over the contacts.
	Real newest(Body::id_t body, const Vector3r& normal) const { return along(newest_, body, normal); }
	void add(Body::id_t body, Real stiffness, const Vector3r& normal);

	/// The newest sums of these bodies, and the step that they are of. The reverse replaces them, if they are not older than those that there are, for
	/// these bodies had no contact since. For processes that have a part of the scene each (py/polytope/mpi).
	std::vector<StiffnessSum> of(const std::vector<Body::id_t>& bodies) const;
	long                      step() const { return step_; }
	void                      take(const std::vector<Body::id_t>& bodies, const std::vector<StiffnessSum>& sums, long step);

private:
	using Sums = std::vector<StiffnessSum>;

	void        beginStep(const Scene& scene);
	static Real along(const Sums& sums, Body::id_t body, const Vector3r& normal);

	long              step_ = -1; ///< of which newest_ is
	Sums              newest_, last_;
	bool              lastKnown_ = false;
	std::atomic<long> begun_ { -1 };
	std::mutex        beginning_;

	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		archive& boost::serialization::make_nvp("step", step_);
		archive& boost::serialization::make_nvp("sums", newest_);
	}
};

} // namespace yade

BOOST_CLASS_IMPLEMENTATION(yade::StiffnessSum, boost::serialization::object_serializable)
BOOST_CLASS_TRACKING(yade::StiffnessSum, boost::serialization::track_never)
