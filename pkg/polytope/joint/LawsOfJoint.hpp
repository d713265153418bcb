// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <src/joint/BartonBandis.hpp>
#include <src/joint/ClosureLaw.hpp>
#include <src/joint/ContinuouslyYielding.hpp>

#include <boost/serialization/nvp.hpp>

/// What a contact keeps of a closure and a shear law of its own (material/JointLaws.hpp): parameters of the joint of both materials, and their state.
namespace yade {

enum class ShearLaw : int { MohrCoulomb = 0, BartonBandis, ContinuouslyYielding };

struct LawsOfJoint {
	polytope::ClosureLaw           closure;
	int                            shear = 0; ///< ShearLaw
	polytope::BartonBandis         rough;
	polytope::ContinuouslyYielding yielding;
	Real                           shearStiffness = 0; ///< of the continuously-yielding joint at its reference stress [Pa/m or N/m]
	Real                           reduction      = 1; ///< tan φ is divided by it
	Real                           slipPath       = 0; ///< all slip so far, whatever its direction [m]
	Real                           dilation       = 0; ///< of the next step [m]
	Real                           steepness      = 0; ///< tangent of the dilation angle of the last slip
	Vector3r                       slipBefore     = Vector3r::Zero(); ///< this step's; not saved
	Real                           stiffening     = 1; ///< tangent over initial stiffness for which the time step was last computed

	ShearLaw law() const { return ShearLaw(shear); }

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		const auto visit = [&](const char* name, auto& value) { archive& boost::serialization::make_nvp(name, value); };
		visitParts(closure, visit);
		visit("shear", shear);
		visitParts(rough, visit);
		visitParts(yielding, visit);
		visit("shearStiffness", shearStiffness);
		visit("reduction", reduction);
		visit("slipPath", slipPath);
		visit("dilation", dilation);
		visit("steepness", steepness);
		visit("stiffening", stiffening);
	}
};

} // namespace yade
