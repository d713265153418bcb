// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Export.hpp"
#include "numbers/Real.hpp"

/// Normal laws of joints that stiffen as they close. All is over the joint's stiffness k [Pa/m]: σ/k is a length, that of the linear spring with the same
/// pressure. Reversible: loading and unloading follow the same curve. In tension each is the linear spring.
///
/// Hyperbola (Bandis, Lumsden & Barton 1983, Int. J. Rock Mech. Min. Sci. 20:249-268), k the initial stiffness, δₘ the maximum closure [m]:
///
///     σ = k δ/(1 − δ/δₘ),        beyond tolerance::closureEnd as its tangent there.
///
/// Power of the stress (Cundall & Hart 1984; Itasca, UDEC, continuously-yielding joint), k the stiffness at the reference stress σ₀, 0 ≤ e < 1:
///
///     dσ/dδ = k (σ/σ₀)ᵉ,         so σ = σ₀ ((1 − e) δ k/σ₀)^(1/(1 − e)).
namespace polytope {

class POLYTOPE_API ClosureLaw {
public:
	/// Linear.
	ClosureLaw() = default;
	/// \param most maximum closure [m], above 0
	static ClosureLaw hyperbola(Real most);
	/// \param exponent e
	/// \param length   σ₀/k [m], above 0
	static ClosureLaw power(Real exponent, Real length);
	/// Joint of two sides, each of which closes by half of its own law: of the same kind; parameters are the means, which is exact
	/// for hyperbolas at low and at high stress, and for powers with the same exponent and reference stress.
	static ClosureLaw between(const ClosureLaw& one, const ClosureLaw& other);

	bool isLinear() const { return most_ == 0 && length_ == 0; }
	/// Both hyperbolas, or both powers.
	bool isLike(const ClosureLaw& other) const { return (most_ > 0) == (other.most_ > 0) && (length_ > 0) == (other.length_ > 0); }
	Real maximumClosure() const { return most_; } ///< 0: not a hyperbola

	Real pressure(Real closure) const; ///< σ/k [m]
	Real tangent(Real closure) const;  ///< dσ/dδ over k [-]
	Real energy(Real closure) const;   ///< ∫ σ/k dδ [m²]
	Real closure(Real pressure) const; ///< that gives σ/k [m]

private:
	Real end() const;

	Real most_ = 0, exponent_ = 0, length_ = 0;

	template <class Visit> friend void visitParts(ClosureLaw& law, const Visit& visit)
	{
		visit("maximumClosure", law.most_);
		visit("exponent", law.exponent_);
		visit("length", law.length_);
	}
};

} // namespace polytope
