# SPDX-License-Identifier: GPL-2.0-or-later
"""What is measured of a scene: arrays, stress, fabric, porosity, energy."""
