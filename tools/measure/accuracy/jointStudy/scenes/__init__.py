# SPDX-License-Identifier: GPL-2.0-or-later
"""Builders of the scenes. One empties the simulation (O.reset), makes bodies and engines, and returns what it made."""
