# SPDX-License-Identifier: GPL-2.0-or-later
"""Builders of the scenes. A builder empties the simulation (O.reset), makes bodies and engines, and returns an object that says what it made."""
