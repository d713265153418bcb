# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines that the scenes with a closed form have in common: all shapes meet polytopes, by one choice of contact."""

from yade import (
	Bo1_Box_Aabb,
	Bo1_Facet_Aabb,
	Bo1_Polytope_Aabb,
	Bo1_Wall_Aabb,
	ForceResetter,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Wall_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
)

__all__ = ['failures', 'jointEngines']

geometries = (
	Ig2_Polytope_Polytope_PolytopeGeom,  # whose settings are those of all
	Ig2_Wall_Polytope_PolytopeGeom,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
)
bounds = (Bo1_Polytope_Aabb, Bo1_Wall_Aabb, Bo1_Box_Aabb, Bo1_Facet_Aabb)


def jointEngines(ig2, perArea, gravity, damping=0.0, verlet=0.01, moving=(), watching=(), **law):
	"""Sets O.engines; returns their NewtonIntegrator.

	:param dict ig2: attributes of Ig2_Polytope_Polytope_PolytopeGeom, for all pairs of shapes: {} or contactModel='boon2012' …
	:param bool perArea: stiffnesses are per area [Pa/m], else per contact [N/m]
	:param gravity: [m/s²]
	:param float damping: YADE's own: NewtonIntegrator.damping
	:param float verlet: how far bodies move before pairs are searched for again [m]
	:param moving: engines that move bodies, before the integrator
	:param watching: engines at the end of the step
	:param law: attributes of Law2_PolytopeGeom_RockJointPhys_MohrCoulomb
	"""
	newton = NewtonIntegrator(gravity=gravity, damping=damping)
	O.engines = [
		ForceResetter(),
		PolytopeCollider([bound() for bound in bounds], verletDist=verlet),
		InteractionLoop(
			[geometries[0](**ig2), *(geometry() for geometry in geometries[1:])],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(**law)],
		),
		*moving,
		newton,
		*watching,
	]
	return newton


def failures():
	"""Queries without an answer so far, of all geometry functors."""
	loop = next(engine for engine in O.engines if isinstance(engine, InteractionLoop))
	return sum(functor.stats()['failures'] for functor in loop.geomDispatcher.functors if isinstance(functor, geometries))
