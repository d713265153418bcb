// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bolt/BoltArchive.hpp"
#include "bolt/PolytopeBoltCrossing.hpp"

namespace yade {

/// One bolt: what it is made of, the state of steel and grout along it, and where it crosses from block to block. For a pattern,
/// PolytopeBolts::make() reads only what a script gives.
class PolytopeBolt : public Serializable {
public:
	virtual ~PolytopeBolt() = default;

	/// Forces from where the bodies are, on them. Bodies that are gone are dropped.
	void act(Scene& scene, bool unlimited);
	/// Allocates what act() needs; after making and loading.
	void prepare();
	/// What the last act() has lost, and to what.
	struct Loss {
		Real energy  = 0;
		bool rupture = false;
		long dropped = 0; ///< crossings of which a body is gone
		bool solved  = true;
	};
	const Loss& loss() const { return loss_; }
	bool        acts() const;

	/// Places of the stations in the world; empty where the block that carries a station is gone.
	std::vector<boost::optional<Vector3r>> stationPoints(const BodyContainer& bodies) const;

	boost::python::list crossingList() const;
	vector<Real>        stations() const;
	vector<Real>        elementForces() const;
	vector<Real>        elementStrains() const;
	vector<Real>        slips() const;
	vector<Real>        groutForces() const;
	vector<Real>        groutStrengths() const;
	Real                headForce() const;
	Real                largestForce() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeBolt, Serializable,
	R"""(One rock bolt or cable, made by *polytope.bolt(…)* and kept by :yref:`PolytopeBolts` (docs/support.md): steel along a straight line,
without mass, held by a face plate at its head and by an anchor at its end or by grout. Along it lie stations: the plate, the anchor, and the nodes
that bear on a block through grout; between two neighbouring stations is an element of steel.)""",
		((Vector3r, head, Vector3r::Zero(), Attr::readonly, "Head, where the bolt was made [m]."))
		((Vector3r, end, Vector3r::Zero(), Attr::readonly, "End, where the bolt was made [m]."))
		((Real, area, 0, Attr::readonly, "Cross-section of the steel [m²]."))
		((Real, youngsModulus, 0, Attr::readonly, "Young's modulus of the steel [Pa]."))
		((Real, yieldForce, std::numeric_limits<Real>::infinity(), Attr::readonly, "Force at which the steel yields, perfectly plastic [N]."))
		((Real, ruptureStrain, std::numeric_limits<Real>::infinity(), Attr::readonly, "Strain at which it breaks [-], plastic strain included."))
		((Real, pretension, 0, Attr::readonly, "Force with which the head was pulled against its plate [N]."))
		((bool, plate, true, Attr::readonly, "Whether a plate holds the head."))
		((Real, groutStiffness, 0, Attr::readonly, "Shear force per length and slip of the grout [N/m²]; 0: no grout, an anchor at the end."))
		((Real, groutStrength, 0, Attr::readonly, "Largest shear force per length of the grout [N/m]."))
		((Real, groutedLength, -1, Attr::readonly, "Length that is grouted, from the end [m]; -1: all."))
		((Real, freeLength, -1, Attr::readonly, "Length of steel that grout does not hold at each joint [m]."))
		((Real, dowelStiffness, 0, Attr::readonly, "Shear force per shear displacement at each joint [N/m]; 0: none."))
		((Real, dowelStrength, 0, Attr::readonly, "Largest shear force at each joint [N]."))
		((Real, energy, 0, Attr::readonly, "Elastic energy of steel, grout and dowels [J]."))
		((Real, firstStation, 0, (Attr::readonly | Attr::hidden), "Distance of the first station from the head"))
		((vector<shared_ptr<PolytopeBoltCrossing>>, crossings, , Attr::hidden, "Crossings in their order from the head"))
		((polytope::BoltChain, chain, , (Attr::readonly | Attr::hidden), "Steel and grout"))
		, /*ctor*/
		, /*py*/
		.add_property("crossings", &PolytopeBolt::crossingList, "Places where it goes over from block to block (:yref:`PolytopeBoltCrossing`), in "
		        "their order from the head.")
		.add_property("stations", &PolytopeBolt::stations, "Distances of plate, nodes and anchor from the head [m]; element $k$ lies "
		        "between stations $k$ and $k+1$.")
		.add_property("elementForces", &PolytopeBolt::elementForces, "Tension of each element of steel [N].")
		.add_property("elementStrains", &PolytopeBolt::elementStrains, "Strain of each element of steel [-], plastic strain and that of the "
		        "pretension included.")
		.add_property("slips", &PolytopeBolt::slips, "Displacement of each node against its block, towards the end [m].")
		.add_property("groutForces", &PolytopeBolt::groutForces, "Force of each node on its block, towards the end [N].")
		.add_property("groutStrengths", &PolytopeBolt::groutStrengths, "Largest force of each node on its block [N]: groutStrength times the "
		        "length that it stands for.")
		.add_property("headForce", &PolytopeBolt::headForce, "Force of the plate on its block [N]; 0 without a plate.")
		.add_property("largestForce", &PolytopeBolt::largestForce, "Largest tension along the bolt [N].")
	);
	// clang-format on

private:
	void dropErased(const BodyContainer& bodies);

	Loss              loss_;
	std::vector<Real> openings_;
};
REGISTER_SERIALIZABLE(PolytopeBolt);

} // namespace yade
