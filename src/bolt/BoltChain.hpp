// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <limits>
#include <vector>

/// A bolt along its own axis: steel between stations, which are held by a block (a plate at the head, an anchor at the end) or bear on it
/// through grout (nodes). It has no mass: the slips v of the nodes are those at which all nodes are balanced,
///
///     Tₑ = Kₑ (oₑ + cₑ + v₊ − v₋ − pₑ),  |Tₑ| ≤ T_y,        Gᵢ = kᵢ (vᵢ − sᵢ),  |Gᵢ| ≤ gᵢ,        T₊ − T₋ = Gᵢ            (1)
///
/// with the opening oₑ of what the element crosses (given: where the blocks are), the elongation cₑ that pretension has locked in, and plastic
/// elongation pₑ and slip sᵢ, which grow where the limits are reached. (1) is the minimum of a convex energy, found by Newton's method with a search
/// along each step. The steel between a plate and what follows bears no compression; an element longer than the steel bears is broken for good.
namespace polytope {

/// Steel between two neighbouring stations.
struct BoltElement {
	Real length    = 0;     ///< [m]
	Real stiffness = 0;     ///< K [N/m]: EA over the length, but for grouted parts see layOut()
	Real locked    = 0;     ///< elongation by pretension [m]
	Real plastic   = 0;     ///< [m]
	Real force     = 0;     ///< tension [N]
	Real strain    = 0;     ///< from the unstressed steel on, plastic strain included
	bool slackens  = false; ///< bears no compression
	bool broken    = false;
};

/// Station that bears on its block through grout.
struct BoltNode {
	Real stiffness   = 0;                                     ///< k [N/m]
	Real strength    = std::numeric_limits<Real>::infinity(); ///< g [N]
	Real slip        = 0;                                     ///< v, towards the end [m]
	Real plasticSlip = 0;                                     ///< s [m]
	Real force       = 0;                                     ///< G on the block, towards the end [N]
};

class BoltChain {
public:
	Real                     axialStiffness = 0;                                     ///< EA [N], for strains
	Real                     yieldForce     = std::numeric_limits<Real>::infinity(); ///< T_y
	Real                     ruptureStrain  = std::numeric_limits<Real>::infinity();
	bool                     headHeld       = false; ///< by a plate: element 0 comes before node 0
	std::vector<BoltElement> elements;
	std::vector<BoltNode>    nodes;

	/// Allocates what solving needs.
	void prepare();

	struct Change {
		bool solved = true;  ///< all nodes are balanced
		bool flowed = false; ///< steel has yielded or grout slipped
		bool broke  = false; ///< steel
	};
	/// Forces for these openings of the elements, from the present state on, which is replaced. Nothing is allocated.
	/// \param unlimited steel does not yield or break, grout does not slip
	Change solve(const std::vector<Real>& openings, bool unlimited = false);

	/// Pulls the head against its plate with this force, and locks it there: from then on the blocks' motion adds to it.
	Change jack(const Real& force);

	/// Tension of an element for its opening alone, all elastic [N/m]: the largest that it can have.
	Real elasticStiffness(std::size_t element);

	/// Elastic energy of steel and grout [J].
	Real energy() const;
	/// Σ g [N].
	Real groutStrength() const;

private:
	struct Answer {
		Real force, tangent;
	};
	Answer steel(const BoltElement& element, const Real& elongation) const;
	Answer grout(const BoltNode& node, const Real& slip) const;
	Real   elongation(std::size_t element, const std::vector<Real>& slips) const;
	long   nodeBefore(std::size_t element) const { return long(element) - (headHeld ? 1 : 0); }
	Answer elementAt(std::size_t element, const std::vector<Real>& slips) const;
	Real   strainOf(std::size_t element) const;
	void   evaluate(const std::vector<Real>& slips);
	Real   largestResidual() const;
	void   newtonStep();
	Real   descent() const;
	bool   isRounding() const;
	bool   search(const Real& first);
	bool   balance();
	bool   commit();
	bool   breakLongest();

	bool                     unlimited_ = false, jacking_ = false;
	Real                     jackingForce_ = 0, largestForce_ = 0;
	const std::vector<Real>* openings_ = nullptr;
	std::vector<Real>        none_, slips_, trial_, residual_, step_, diagonal_, across_;
};

} // namespace polytope
