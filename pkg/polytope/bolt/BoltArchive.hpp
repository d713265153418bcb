// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <boost/serialization/level.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/tracking.hpp>
#include <boost/serialization/vector.hpp>

#include <src/bolt/BoltChain.hpp>

/// How archives have the steel and the grout of a bolt.
namespace polytope {

template <class Archive> void serialize(Archive& archive, BoltElement& element, unsigned int)
{
	for (Real* number : { &element.length, &element.stiffness, &element.locked, &element.plastic, &element.force, &element.strain })
		archive& boost::serialization::make_nvp("number", *number);
	for (bool* flag : { &element.slackens, &element.broken })
		archive& boost::serialization::make_nvp("flag", *flag);
}

template <class Archive> void serialize(Archive& archive, BoltNode& node, unsigned int)
{
	for (Real* number : { &node.stiffness, &node.strength, &node.slip, &node.plasticSlip, &node.force })
		archive& boost::serialization::make_nvp("number", *number);
}

template <class Archive> void serialize(Archive& archive, BoltChain& chain, unsigned int)
{
	for (Real* number : { &chain.axialStiffness, &chain.yieldForce, &chain.ruptureStrain })
		archive& boost::serialization::make_nvp("number", *number);
	archive& boost::serialization::make_nvp("headHeld", chain.headHeld);
	archive& boost::serialization::make_nvp("elements", chain.elements);
	archive& boost::serialization::make_nvp("nodes", chain.nodes);
}

} // namespace polytope

BOOST_CLASS_IMPLEMENTATION(polytope::BoltElement, boost::serialization::object_serializable)
BOOST_CLASS_TRACKING(polytope::BoltElement, boost::serialization::track_never)
BOOST_CLASS_IMPLEMENTATION(polytope::BoltNode, boost::serialization::object_serializable)
BOOST_CLASS_TRACKING(polytope::BoltNode, boost::serialization::track_never)
BOOST_CLASS_IMPLEMENTATION(polytope::BoltChain, boost::serialization::object_serializable)
BOOST_CLASS_TRACKING(polytope::BoltChain, boost::serialization::track_never)
