// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/GlobalEngine.hpp>

#include <boost/python/tuple.hpp>

#include <src/shape/WaterPressure.hpp>

namespace yade {

class PolytopeWater : public GlobalEngine {
public:
	void action() override;
	/// Refuses lists of other lengths than they must have, and what is not finite.
	void postLoad(PolytopeWater&);

	/// Force and moment on a body where it is, and where it may have been moved by the script.
	boost::python::tuple load(int id) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeWater, GlobalEngine,
	R"""(Presses on the faces of :yref:`Polytopes<Polytope>` with the pressure of water, after the :yref:`InteractionLoop` and before
:yref:`NewtonIntegrator` (*polytope.water(…)* makes it and puts it there; docs/water.md). The pressure is a field in space that is linear in pieces
and does not change; in each step it is integrated exactly over the faces where they are. Several engines of this kind add up. Other shapes have no
water.)""",
		((vector<Vector3r>, points, , Attr::readonly, "Point of each piece at which it has its value [m]."))
		((vector<Real>, values, , Attr::readonly, "Pressure of each piece at its point [Pa]. Where value and gradient make it negative "
		        "there is none."))
		((vector<Vector3r>, gradients, , Attr::readonly, "Gradient of the pressure of each piece [Pa/m]."))
		((vector<Vector3r>, sides, , Attr::readonly, "Three for each piece: unit outward normals of what bounds it; zero: none."))
		((vector<Real>, sideOffsets, , Attr::readonly, "Distance of each side from the piece's point along its normal [m]."))
		((bool, someFaces, false, Attr::readonly, "Whether there is water on some faces only: those of *wetBodies* and *wetPlanes*."))
		((vector<int>, wetBodies, , Attr::readonly, "Body of each such face."))
		((vector<int>, wetPlanes, , Attr::readonly, "Index of the half-space of each such face in :yref:`Polytope.normals`."))
		, /*ctor*/
		, /*py*/
		.def("load", &PolytopeWater::load, boost::python::arg("id"), "Force [N] of the water on a body as it is now, and its moment about "
		        "the body's position [N m], as a tuple; for a clump those on its members together. Zero while the engine is dead.")
	);
	// clang-format on

private:
	polytope::WaterLoad loadOn(const Body& body, polytope::ClippedFace& memory) const;

	std::vector<polytope::PressurePiece> pieces_;
	std::vector<std::vector<int>>        wet_; ///< by body: planes of its wet faces, ascending
	std::vector<polytope::ClippedFace>   memory_;
};
REGISTER_SERIALIZABLE(PolytopeWater);

} // namespace yade
