// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/TimeStepLimits.hpp"

#include <core/Material.hpp>

#include <array>
#include <map>
#include <tuple>
#include <vector>

/// Time step before a contact exists: each body is given the one contact that would give it the highest frequency.
///
/// Its stiffnesses are those that the scene's own Ip2 functor gives the body's material and that of any other body, called with a
/// contact that is not in the scene. Considered are a contact at the farthest vertex (a stiffness per contact, or by the bodies' sizes) and
/// one on a whole face (a stiffness per area), each with the arm, and the latter with the rocking, that belongs to it. A body in contact with several
/// others at once is held more stiffly: contactLimit() includes these contacts once they exist.
namespace yade {

class PotentialContacts {
public:
	TimeStepLimit limit(Scene& scene);
	/// Limit of each body, by id [s]; infinite where nothing limits it.
	std::vector<Real> steps(Scene& scene);

private:
	/// What a contact at a place of a body would be.
	struct Place {
		Real unit = 0; ///< κ of a contact of stiffness 1 [1/kg]
		Real area = 0; ///< of the contact [m²]
	};
	/// The contact places of highest frequency of a body or a clump's member, and the properties for which they were found.
	struct Part {
		const void*          shape    = nullptr;
		Real                 mass     = 0;
		Vector3r             inertia  = Vector3r::Zero();
		unsigned int         blocked  = 0;
		Real                 distance = 0; ///< from the clump's centre
		Real                 size     = 0; ///< as contactSizes() has it
		Place                vertex;
		std::array<Place, 3> face; ///< by FaceForce (RockingStiffness.hpp)

		bool isOf(const Part& other) const
		{
			return shape == other.shape && mass == other.mass && inertia == other.inertia && blocked == other.blocked
			        && distance == other.distance;
		}
	};
	/// All bodies of one material.
	struct Partners {
		shared_ptr<Material> material;
		Body::id_t           one = Body::ID_NONE, other = Body::ID_NONE;
		Real                 size      = 0;     ///< the largest
		Real                 area      = 0;     ///< of the largest face of each: a face may lie on many pieces
		bool                 polytopes = false; ///< there are some
		bool                 asLarge   = false; ///< there are some that count as large as what they touch
	};
	struct Stiffness {
		Real normal = 0, shear = 0;
	};
	using Key = std::tuple<const Material*, const Material*, bool, Real, Real>;

	/// Calls visit(step, body id) for all bodies that can move, and members of clumps.
	template <class Visit> void forSteps(Scene& scene, const Visit& visit);
	void                        collect(const Scene& scene);
	const Part&                 partOf(const Body& part, const Body& mover);
	const Stiffness&            stiffness(const Body& part, Real partOwnSize, Partners& partners, const Place& place, Scene& scene);

	std::vector<Part>        parts_; ///< by body id
	std::vector<Partners>    partners_;
	std::map<Key, Stiffness> asked_; ///< of this call
};

} // namespace yade
