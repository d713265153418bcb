// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Export.hpp"
#include "numbers/Real.hpp"

#include <string>
#include <vector>

/// Normal laws of joints that stiffen as they close. All is over the joint's stiffness k [Pa/m]: σ/k is a length, that of the linear spring
/// with the same pressure. Reversible: loading and unloading follow the same curve. In tension each is the linear spring. Besides these two
/// a program has laws of its own.
///
/// Hyperbola (Bandis, Lumsden & Barton 1983, Int. J. Rock Mech. Min. Sci. 20:249-268), k the initial stiffness, δₘ the maximum closure [m]:
///
///     σ = k δ/(1 − δ/δₘ),        beyond tolerance::closureEnd as its tangent there.
///
/// Power of the stress (Cundall & Hart 1984; Itasca, UDEC, continuously-yielding joint), k the stiffness at the reference stress σ₀, 0 ≤ e < 1:
///
///     dσ/dδ = k (σ/σ₀)ᵉ,         so σ = σ₀ ((1 − e) δ k/σ₀)^(1/(1 − e)).
namespace polytope {

/// A law of a program's own, for closures δ > 0: functions of δ and of two parameters p, q. It must outlive all contacts that have it, as a
/// static object of a library does; its name, which archives have in its place, is known from then on, so it is made once. Nothing is
/// looked at then: ClosureLaw::own() refuses a name that another law has, ClosureLaw::fault() says whether the functions belong together.
struct POLYTOPE_API NormalLaw {
	using Function = Real (*)(Real closure, Real p, Real q);

	NormalLaw(const char* name, Function pressure, Function tangent, Function energy);
	NormalLaw(const NormalLaw&)            = delete;
	NormalLaw& operator=(const NormalLaw&) = delete;
	/// Refuses (std::runtime_error) a name that there is none of.
	static const NormalLaw& named(const std::string& name);
	/// All laws that were made, in this order; a name that several have means the first of them.
	static std::vector<const NormalLaw*>& all();
	/// Says that it has no name, not all functions, or the name of another law that was made before it; an empty text: none of these.
	std::string fault() const;

	const char* const name;
	const Function    pressure; ///< σ/k [m]: 0 at δ = 0, rising
	const Function    tangent;  ///< its slope [-]
	const Function    energy;   ///< its integral from 0 [m²]
};

class POLYTOPE_API ClosureLaw {
public:
	/// Linear.
	ClosureLaw() = default;
	/// \param most maximum closure [m], above 0
	static ClosureLaw hyperbola(Real most);
	/// \param exponent e
	/// \param length   σ₀/k [m], above 0
	static ClosureLaw power(Real exponent, Real length);
	/// A program's own law. Refuses (std::invalid_argument) a law whose name another one has. \param p, q its parameters
	static ClosureLaw own(const NormalLaw& law, Real p = 0, Real q = 0);
	/// Joint of two sides, each of which closes by half of its own law. The laws are of the same kind; parameters are the means, which is exact
	/// for hyperbolas at low and at high stress, and for powers with the same exponent and reference stress.
	static ClosureLaw between(const ClosureLaw& one, const ClosureLaw& other);

	bool isLinear() const { return most_ == 0 && length_ == 0 && !own_; }
	/// Whether both are hyperbolas, both powers, or both the same law of a program's own.
	bool isLike(const ClosureLaw& other) const
	{
		return own_ == other.own_ && (most_ > 0) == (other.most_ > 0) && (length_ > 0) == (other.length_ > 0);
	}
	Real maximumClosure() const { return most_; } ///< 0: not a hyperbola

	Real pressure(Real closure) const; ///< σ/k [m]
	Real tangent(Real closure) const;  ///< dσ/dδ over k [-]
	Real energy(Real closure) const;   ///< ∫ σ/k dδ [m²]
	Real initialTangent() const;       ///< of a joint that has not closed yet [-]: above 1 it is stiffer there than k
	Real closure(Real pressure) const; ///< that gives σ/k [m]

	/// Whether these belong together: a sentence that names the law and what does not, or an empty one. At closures from
	/// tolerance::leastClosure on, by tolerance::closureOctaves octaves, all are finite, and the pressure rises from 0; in each octave it
	/// grows by the integral of the tangent, and the energy by that of the pressure, to tolerance::closureAgreement. It takes a tenth of a
	/// millisecond: for where a law is given, not for each contact.
	std::string fault() const;

private:
	Real end() const;
	Real ownClosure(Real pressure) const;

	Real             most_ = 0, exponent_ = 0, length_ = 0;
	const NormalLaw* own_ = nullptr;
	Real             p_ = 0, q_ = 0; ///< of own_

	template <class Visit> friend void visitParts(ClosureLaw& law, const Visit& visit)
	{
		visit("maximumClosure", law.most_);
		visit("exponent", law.exponent_);
		visit("length", law.length_);
		std::string name = law.own_ ? law.own_->name : "";
		visit("normalLaw", name);
		law.own_ = name.empty() ? nullptr : &NormalLaw::named(name);
		visit("p", law.p_);
		visit("q", law.q_);
	}
};

} // namespace polytope
