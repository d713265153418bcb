# SPDX-License-Identifier: GPL-2.0-or-later
"""Builders of scenes, shared by examples, tests and benchmarks: one file for each family of scenes.

A builder empties the simulation (O.reset), makes bodies and engines, and returns an object that says what it made.
"""
from .falling import FallingPolyhedra, circumradiusOfUnitVolume, solids

__all__ = ['FallingPolyhedra', 'circumradiusOfUnitVolume', 'solids']
