# SPDX-License-Identifier: GPL-2.0-or-later
"""Builders of scenes, shared by examples, tests and benchmarks: one file for each family of scenes.

A builder empties the simulation (O.reset), makes bodies and engines, and returns an object that says what it made.
"""
from .arch import MasonryArch
from .blockGeometry import BlockGeometry, touchingRoofBlocks
from .beam import BeamReading, ThreeHingedBeam
from .blockOnBase import RockingBlock, ShakenBlock, TiltedBlock, Verdict
from .collisions import Block, Collision, readBlocks
from .facetGrains import EnergyBook, FacetDrum, FacetFunnel
from .falling import FallingPolyhedra, circumradiusOfUnitVolume, solids
from .releasedCube import CubeOnSlope, edgeNormal, wallKick
from .rollingSolid import RollingSolid
from .slope import SlumpingSlope, readSlope
from .roofWedge import RoofWedge
from .wedge import Joint, WedgeScene, stiffnessFactors

__all__ = ['BeamReading', 'Block', 'BlockGeometry', 'Collision', 'CubeOnSlope', 'EnergyBook', 'FacetDrum', 'FacetFunnel', 'FallingPolyhedra', 'Joint', 'MasonryArch', 'RockingBlock', 'RollingSolid', 'RoofWedge', 'ShakenBlock', 'ThreeHingedBeam', 'TiltedBlock', 'Verdict', 'WedgeScene', 'circumradiusOfUnitVolume', 'edgeNormal', 'readBlocks', 'solids', 'stiffnessFactors', 'touchingRoofBlocks', 'wallKick']
