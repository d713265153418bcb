# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation D: a wedge in the roof of an excavation, held by friction and stress."""
