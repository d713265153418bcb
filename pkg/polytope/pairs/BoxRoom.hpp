// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <src/shape/ConvexShape.hpp>

#include <memory>

namespace yade {

/// How far bodies may move within their boxes, and which of them have moved out.
///
/// A box is made for the pose that its body has then. It has room for the body's translation, a sweep length along each axis, and, for a
/// polytope, for
/// rotation: the displacement of its farthest vertex. YADE's BoundDispatcher finds the sweep length from the motion since the last box was
/// made, so that it is enough for `targetInterv` steps; the room for rotation is found in the same way. Shapes other than balls and
/// polytopes, and classes derived from Polytope that do not say their margin, have no room to turn.
class BoxRoom {
public:
	/// What the box of one body was made for.
	struct Reference {
		shared_ptr<State> state; ///< of the body; none if it has no box
		Vector3r          position    = Vector3r::Zero();
		Quaternionr       orientation = Quaternionr::Identity();
		Real              sweep       = 0; ///< along each axis
		Real              radius      = 0; ///< of the ball about the centre in which it turns; zero: a turn needs no room
		Real              margin      = 0; ///< Polytope::margin()
		/// The shape that the body had then: it may be exchanged. None where the shape's planes do not say where the surface is.
		std::shared_ptr<const polytope::ConvexShape> convex;
		/// Degrees of freedom of the body that were blocked then: where others are now, it may touch what it did not (outside()).
		unsigned blockedDOFs = 0;
		/// Whether it was fixed, and whether it was so without velocity: pairs of such bodies are left out until one of them is freed, gets a
		/// velocity or is put elsewhere.
		bool fixed = false, still = false;
	};

	/// What a box may be enlarged by for a rotation [m], and for how many steps it should last.
	struct Limits {
		Real most, least;
		int  targetInterv;
	};

	/// For how many steps boxes should last: where targetInterv is 0, as yade.mpy sets it, YADE's default.
	static int steps(int targetInterv) { return targetInterv > 0 ? targetInterv : 100; }

	/// By body id; a room is infinite where the box holds the body in every orientation.
	const std::vector<Real>&      rooms() const { return rooms_; }
	const std::vector<Reference>& references() const { return references_; }

	/// Before boxes are made, of all bodies or of these: room to turn.
	void makeForAll(const Scene& scene, const Limits& limits);
	void make(const Scene& scene, const std::vector<Body::id_t>& ids, const Limits& limits);

	/// After they have been made.
	void takeFromAll(const Scene& scene);
	void take(const Scene& scene, const std::vector<Body::id_t>& ids);

	/// Ids of bodies that are out of their boxes, freed, or no longer still, in ascending order; by translation, too: in periodic cells YADE's
	/// own collider looks for those.
	std::vector<Body::id_t> outside(const Scene& scene, bool byTranslation) const;

	/// Whether one of these bodies, or of all, was fixed when its box was made and no longer is.
	bool hasFreed(const Scene& scene, const std::vector<Body::id_t>& ids) const;
	bool hasFreed(const Scene& scene) const;

private:
	void makeOne(const Scene& scene, std::size_t id, const Limits& limits);
	void takeOne(const Scene& scene, std::size_t id);
	void letGo(shared_ptr<State>& state);
	void releaseStates();
	bool isOutside(std::size_t id, bool byTranslation) const;
	bool isFreed(const Scene& scene, std::size_t id) const;

	std::vector<Reference> references_;
	std::vector<Real>      rooms_;
	/// Of bodies that were erased, or given others.
	std::vector<shared_ptr<State>> gone_;
};

} // namespace yade
