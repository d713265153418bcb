# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation B: a three-hinged beam between two abutments, loaded until it snaps through."""
