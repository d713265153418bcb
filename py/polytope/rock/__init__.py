# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints of a rock mass: single ones, random sets, files of them, and what is measured of the blocks that they make (jointedRock.py cuts)."""
