# SPDX-License-Identifier: GPL-2.0-or-later
"""Jointed rock: joints and the blocks that they cut, stress and excavation (stress), water, linings, limit analysis (limit) and the factor
of safety."""
