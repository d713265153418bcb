# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation C: a wedge on two joints of a slope; its scene is that of ../wedges."""
