# SPDX-License-Identifier: GPL-2.0-or-later
"""Builders of scenes, shared by examples, tests and benchmarks: one file for each family of scenes.

A builder empties the simulation (O.reset), makes bodies and engines, and returns an object that says what it made.
"""
from .blockGeometry import BlockGeometry, touchingRoofBlocks
from .beam import BeamReading, ThreeHingedBeam
from .collisions import Block, Collision, readBlocks
from .falling import FallingPolyhedra, circumradiusOfUnitVolume, solids
from .slope import SlumpingSlope, readSlope
from .roofWedge import RoofWedge
from .wedge import Joint, WedgeScene, stiffnessFactors

__all__ = ['BeamReading', 'Block', 'BlockGeometry', 'Collision', 'FallingPolyhedra', 'Joint', 'RoofWedge', 'ThreeHingedBeam', 'WedgeScene', 'circumradiusOfUnitVolume', 'readBlocks', 'solids', 'stiffnessFactors', 'touchingRoofBlocks']
