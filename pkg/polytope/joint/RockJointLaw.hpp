// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeom.hpp"
#include "host/CheckedAttributes.hpp"
#include "joint/RockJointPhys.hpp"
#include "joint/StiffnessSums.hpp"

#include <core/Dispatching.hpp>

#include <array>
#include <atomic>

/// The law of rock joints: springs, Mohr–Coulomb strength, dilation, dampers, and the accounting of their energy.
///
/// Signs as in RockJointPhys.hpp; relative velocities are body 2's relative to body 1.
namespace yade {

class Law2_PolytopeGeom_RockJointPhys_MohrCoulomb : public LawFunctor {
public:
	class Shear;

	bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* contact) override;
	/// Refuses negative damping, naming the attribute, and restores the last good values.
	void postLoad(Law2_PolytopeGeom_RockJointPhys_MohrCoulomb&);
	Real ratioSlidingContacts() const;
	long nonFiniteForces() const { return nonFinite_; }
	/// Whether a joint has stiffened so much since the last call that the time step must be computed anew (tolerance::stiffening).
	bool hasStiffened() const { return stiffened_.exchange(false); }
	FUNCTOR2D(PolytopeGeom, RockJointPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, LawFunctor,
	R"""(Elastic joint with Mohr-Coulomb strength, after [Hart1988]_ and [Boon2012]_.

* Normal force $f_n=k_n(u_n+u_d)$, with the :yref:`penetrationDepth<ScGeom.penetrationDepth>` $u_n$ and the :yref:`dilation<RockJointPhys.dilation>`
  $u_d$; the contact is found for bodies that are nearer by $u_d$ (docs/contact-force.md). Compression without limit; tension while the joint is intact and $-f_n\le\sigma_t A$. When $u_n+u_d<0$ otherwise, the contact ends; one that
  has lost its strength, or has slipped and dilates, is kept without force as long as the gap is smaller than the bodies, so that it regains no
  strength and keeps its dilation when it closes. The area is that of the last overlap while the bodies are apart.
* An intact joint with tensile strength and a stiffness per area holds over the whole area of its two faces, however it is tilted: from the step in
  which the faces lie on each other it is a bond (:yref:`RockJointPhys.bond`, docs/bonds.md) without force where they are flush, whose stress at the
  edge, too, must stay below $\\sigma_t$ and whose shear stress below $c-\\sigma\\tan\\phi$. Where the former fails the tensile strength is lost (with
  it the friction angle becomes the residual one, if there is no cohesion), where the latter fails the joint does.
* Shear is a bed of springs over the outline of the contact area (docs/contact-force.md). Faces are rigid: its state is a force $\vec f_s$ at the
  area's centroid (:yref:`RockJointPhys.shearPoint`) and a moment $m$ about the normal (:yref:`RockJointPhys.twistingMoment`). The force is turned
  with the contact normal (Eq. 18 of [Boon2012]_, :yref:`ScGeom`'s rotation with the bodies' mean spin about the normal; kept tangent and of unchanged
  length); both are incremented by $-k_s\Delta\vec u_s$ and $-k_s\rho^2\Delta\theta$ from the relative velocity at that centroid and the relative spin
  about the normal, $\rho^2$ the mean square of the distance from the centroid. Polygons, spheres and the contacts of *contactModel* = boon2012 have
  no moment: for them shear acts at the contact point. Stiffness per area is $k_s=k_s'A$: springs that leave a shrinking area take their force along,
  those that came last leave first; those that join a growing area are unstrained, and the force stays in its line. Neither creates energy. With a
  stiffness per contact this holds for the :yref:`share<PolytopeGeom.share>` of each of several pieces.
* Strength at each place $c+p\tan\phi$, the pressure $p$ linear over the outline with its centroid at the contact point; where faces slip by a
  displacement and a rotation, force and moment are those of friction against the slip at each place (limit surface, Goyal, Ruina & Papadopoulos 1991,
  Wear 143:307-352), without partial slip. Without rotation that is $|\vec f_s|\le cA+f_n\tan\phi$, through the centroid of the pressure. At its first
  slip an intact joint fails: cohesion and tensile strength are lost and the friction angle becomes the residual one, in that same step.
* Dilation $u_d=\min(|\vec u_p|\tan\psi,\ u_{max})$ with the net plastic slip $\vec u_p$ up to the last step: slip back to where it started closes the
  joint again. In each step $\vec u_p$ grows by the motion along the joint less the change of elastic displacement; in an open joint all motion along
  it is slip.
* Viscous damping $c=2\zeta\sqrt{m k}$ with $1/m=1/(s_1m_1)+1/(s_2m_2)$ (bodies that cannot move count as infinitely heavy, members of a clump with
  the clump's mass). $s$ is the part of a body's mass that this contact carries: its stiffness over that of all contacts of the body along its normal,
  $k/\sum_jk_j(\vec n_j\cdot\vec n)^2$, as they were in the last step; 1 for a contact that is alone, so that the contacts of a body on many pieces
  damp as one does. At its first step a contact has the part of the area that the body shows. No damper takes more than the relative momentum at the
  contact point, $c\Delta t\le1/(w_1/s_1+w_2/s_2)$ with $w$ the velocity that either body has there from an impulse of one. A joint that cannot take
  tension is not pulled by the damper: $f_n$ and the viscous force together are at least 0. It leaves out what a sliding joint rises by its dilation. The sum enters the Coulomb strength. Shear damping acts
  while the joint sticks, on sliding and on turning about the normal, and no further than to the strength. An explicit damper shortens the stable time
  step to $2(\sqrt{1+\zeta^2}-\zeta)\sqrt{m/k}$, which :yref:`GlobalStiffnessTimeStepper` neglects, as it neglects the rotation of a body about a
  contact off its centre, with stiffness $k_n$: keep its *timestepSafetyCoefficient* at 0.5 or lower for $k_s<0.3k_n$ or $\zeta>0.5$.
* Rocking damping: a normal damper at one contact point carries no moment, so it leaves rocking about that point undamped. With
  :yref:`rockingDamping<Law2_PolytopeGeom_RockJointPhys_MohrCoulomb.rockingDamping>` the bodies' relative rotation about the contact's tangents is
  resisted by the moment of dampers spread over the contact area, $\vec m=-2\zeta\sqrt{m k_n}\,\rho^2\vec\omega_t$ with $\rho^2=A/12$ (that of a
  square; polygons: length²/12), at most $\sqrt3\rho f_n$, where the force's line leaves that square. It vanishes at vertices and edges.

With O.trackEnergy: *elastPotential* (stored, normal and shear), *plastDissip* (friction, and shear energy of springs that leave or join the area,
less the work of dilation), *normDampDissip* (viscous, normal and rocking) and *shearDampDissip*, *fractureDissip* (lost when a joint fails in
tension), and *nonconservative*: what the contact forces took from the bodies (negative: gave to them) beyond all these. With the *surface*
:yref:`contactModel<Ig2_Polytope_Polytope_PolytopeGeom.contactModel>` the normal force of every pair is the gradient of an energy, and the term is
zero to second order in the time step; with *boon2012* it is not, and energy can be created, which is counted here. Work is taken over each step with
the mean of the forces at both ends; the sum of all terms is constant to rounding, while the time step is, with the kinetic energy
$\frac12 m\vec v_{n-1/2}\cdot\vec v_{n+1/2}$, from which :yref:`NewtonIntegrator`'s own, $\frac12 m v_{n-1/2}^2$, differs by half a step's work,
$\frac12\vec f\cdot\vec v\Delta t$.)""",
		((Real, normalDamping, 0, Attr::triggerPostLoad, "Viscous damping in the normal direction, fraction $\\zeta$ of critical [-], at "
		        "least 0."))
		((Real, shearDamping, 0, Attr::triggerPostLoad, "Viscous damping in the shear direction, fraction $\\zeta$ of critical [-], at "
		        "least 0."))
		((Real, rockingDamping, 0, Attr::triggerPostLoad, "Damping of rocking on a contact area: fraction $\\zeta$ of the critical normal "
		        "damper, spread over that area [-], at least 0."))
		((bool, unbreakable, false, Attr::noSave, "Joints that touch do not slip, and intact ones do not fail and bear any tension: for "
		        "coming to rest under loads that begin at once, see *polytope.settle*. Not saved."))
		((StiffnessSums, stiffnessSums, , (Attr::readonly | Attr::hidden), "What contacts each body has, for dampers"))
		, /*ctor*/
		, /*py*/
		.def("ratioSlidingContacts", &Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::ratioSlidingContacts,
		        "Fraction of the contacts of this law that slide in this step [-]; 0 without contacts.")
		.def("nonFiniteForces", &Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::nonFiniteForces, "How often a contact gave a force that is "
		        "not a number (from such a value set in a script) and was left out.")
	);
	// clang-format on

private:
	struct Pair;
	struct Last;
	struct StepWork;
	struct DampedBody;
	struct DampedPair;
	bool     damps() const { return normalDamping > 0 || shearDamping > 0 || rockingDamping > 0; }
	bool     act(PolytopeGeom& geom, RockJointPhys& phys, Interaction* contact);
	bool     actsAsBond(Interaction& contact, PolytopeGeom& geom, RockJointPhys& phys, const Last& last, const Vector3r& elasticShear);
	Real     risingWithSlip(const Pair& pair, const RockJointPhys& phys, const Shear& shear, Real widening) const;
	bool     limitShear(RockJointPhys& phys, Real normal, Shear& shear) const;
	Real     normalDamper(const Pair& pair, const DampedPair& damped, const RockJointPhys& phys, Real elastic, Real rising) const;
	Vector3r shearDamper(
	        const Pair& pair, const DampedPair& damped, const RockJointPhys& phys, Real normal, const Vector3r& shear) const;
	Vector3r rockingDamper(const Pair& pair, const DampedPair& damped, const RockJointPhys& phys, Real normal) const;
	void     takePart(const Pair& pair, const DampedPair& damped, RockJointPhys& phys);
	bool     apply(const Pair& pair, RockJointPhys& phys);
	bool     open(const Pair& pair, RockJointPhys& phys, const Last& last, Shear& shear);
	void     beginOwnLaws(RockJointPhys& phys, const PolytopeGeom& geom) const;
	void     followOwnLaws(RockJointPhys& phys, Shear& shear, Real overlap, Real normal) const;
	void     endOwnLaws(RockJointPhys& phys, const Shear& shear, Real normal) const;
	void     nameEnergies();
	void     book(const Pair& pair, RockJointPhys& phys, const Last& last, StepWork work);

	enum Energy { elastic, plastic, normalViscosity, shearViscosity, fracture, nonconservative, energyCount };
	std::array<int, energyCount>        energyIds_ { { -1, -1, -1, -1, -1, -1 } };
	std::atomic<bool>                   energiesNamed_ { false };
	std::atomic<long>                   nonFinite_ { 0 };
	mutable std::atomic<bool>           stiffened_ { false };
	CheckedAttributes<Real, Real, Real> checked_ { std::tie(normalDamping, shearDamping, rockingDamping) };
};
REGISTER_SERIALIZABLE(Law2_PolytopeGeom_RockJointPhys_MohrCoulomb);

} // namespace yade
