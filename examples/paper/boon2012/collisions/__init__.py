# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation F: collisions vertex on face and edge on edge."""
