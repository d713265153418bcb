# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation A: regular polyhedra fall onto a floor between four walls."""
