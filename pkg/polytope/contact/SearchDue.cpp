// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SearchDue.hpp"

#include <src/numbers/Tolerances.hpp>

#include "host/PartsOfBodies.hpp"

namespace yade {

namespace {

	/// Whether a plane of one of several pieces has come to bound the overlap, which may be an internal face or an end of the pieces.
	bool hasMetMore(const Interaction& contact, Scene& scene, const polytope::KeptVertices& last, const polytope::KeptVertices& now)
	{
		return (now.hasOtherPlanesThan(last, 0) && isPiece(*Body::byId(contact.getId1(), &scene)))
		        || (now.hasOtherPlanesThan(last, 1) && isPiece(*Body::byId(contact.getId2(), &scene)));
	}

	/// Whether it may have where it is not known what bounds the overlap: until the next search the bodies move as far as matters.
	bool mayMeetMore(const MotionInStep& motion, const Real& ball)
	{
		return motion.translation.norm() * polytope::tolerance::internalFacesEvery > Real(polytope::tolerance::flushOfDepth) * ball;
	}

} // namespace

bool isTurn(const Interaction& contact, const Scene& scene, int every)
{
	return (scene.iter + contact.getId1() + contact.getId2()) % every == 0;
}

/// The last contact point is not where it was on both bodies then.
bool wasPutElsewhere(const polytope::PairMemory& memory, const polytope::PlacedPair& pair)
{
	if (!memory.hasPoint) return false;
	const Vector3r apart = *pair.rotation[0] * memory.point[0] - *pair.rotation[1] * memory.point[1] - *pair.centre2;
	const Real     size  = math::min(pair.shape[0]->boundingRadius(), pair.shape[1]->boundingRadius());
	return apart.norm() > Real(polytope::tolerance::putElsewhere) * size;
}

/// In an impact the overlap grows within a few steps, and reaches other pieces.
bool mayHaveMetMore(const Interaction& contact, Scene& scene, const PolytopeGeom& geom, const polytope::ContactResult& result,
        const MotionInStep& motion, const polytope::KeptVertices& last, const polytope::KeptVertices& now)
{
	if (math::abs(sizeOfOverlap(result) - geom.sizeAtSearch) > Real(polytope::tolerance::overlapChanged) * geom.sizeAtSearch)
		return true;
	return now.vertices > 0 ? hasMetMore(contact, scene, last, now) : mayMeetMore(motion, -result.infeasibility);
}

} // namespace yade
