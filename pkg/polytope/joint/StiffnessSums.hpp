// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <boost/serialization/level.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/tracking.hpp>
#include <boost/serialization/vector.hpp>

#include "host/Prefetch.hpp"

#include <array>
#include <atomic>
#include <mutex>
#include <vector>

namespace yade {

/// What is on the other side of a contact.
enum class Across : int { Mover = 0, Support }; ///< a body that forces move, or one that they do not

inline Across otherThan(Across across) { return across == Across::Mover ? Across::Support : Across::Mover; }

/// Two symmetric matrices, by what is across: xx, yy, zz, yz, zx, xy.
struct StiffnessSum {
	using Matrix = std::array<Real, 6>;
	std::array<Matrix, 2> value { { { { 0, 0, 0, 0, 0, 0 } }, { { 0, 0, 0, 0, 0, 0 } } } };

	/// nᵀ (Σ k n nᵀ) n.
	Real along(Across across, const Vector3r& n) const
	{
		const Matrix& s = value[std::size_t(across)];
		return s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + s[2] * n[2] * n[2]
		        + 2 * (s[3] * n[1] * n[2] + s[4] * n[2] * n[0] + s[5] * n[0] * n[1]);
	}

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		for (Matrix& matrix : value)
			for (Real& one : matrix)
				archive& boost::serialization::make_nvp("value", one);
	}
};

/// Σ kₙ n nᵀ over the contacts of each body (of a clump: of its members), by the body's id. Contacts with bodies that move have one sum, those with
/// bodies that do not another: a soft joint on a block that a stiff one holds to the ground is damped as if the block were the ground.
///
/// A damper that is to be critical for a body has to know what else carries it. The contacts of a step are computed one after the other, by
/// several threads, so that the sum of this step is not known yet: each contact reads the sum of the last step, and adds to that of this
/// one. Between two steps the newest sum is whole; archives have it, so that a run which is loaded goes on as if it had not been
/// interrupted.
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

	/// To be called before a contact reads or adds: the first call in a step begins a new sum. Allocates where bodies were added.
	void begin(const Scene& scene)
	{
		if (begun_.load(std::memory_order_acquire) != scene.iter) beginStep(scene);
	}
	/// Whether there is a sum of the last step. Not where nothing was damped in it, or the law is a new one.
	bool lastKnown() const { return lastKnown_; }
	/// Sum of the last step [N/m].
	const StiffnessSum& last(Body::id_t body) const { return ofBody(last_, body); }
	/// Sum of the newest step [N/m]; for use between two loops over the contacts.
	const StiffnessSum& newest(Body::id_t body) const { return ofBody(newest_, body); }
	/// Prefetches what a contact of this body reads and adds to.
	void fetch(Body::id_t body) const
	{
		prefetch::fetch(&last(body), sizeof(StiffnessSum));
		prefetch::fetch(&newest(body), sizeof(StiffnessSum));
	}
	void add(Body::id_t body, Across across, Real stiffness, const Vector3r& normal);

	/// The newest sums of these bodies, and the step that they are of. The reverse replaces them, if they are not older than those that there are, for
	/// these bodies had no contact since. For processes that have a part of the scene each (py/polytope/mpi).
	std::vector<StiffnessSum> of(const std::vector<Body::id_t>& bodies) const;
	long                      step() const { return step_; }
	void                      take(const std::vector<Body::id_t>& bodies, const std::vector<StiffnessSum>& sums, long step);

private:
	using Sums = std::vector<StiffnessSum>;

	void                       beginStep(const Scene& scene);
	static const StiffnessSum& ofBody(const Sums& sums, Body::id_t body)
	{
		if (body >= 0 && std::size_t(body) < sums.size()) return sums[std::size_t(body)];
		static const StiffnessSum none;
		return none;
	}

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
