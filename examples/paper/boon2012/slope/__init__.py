# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation E: a slumping slope with joints that do not daylight."""
