# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy of collisions: the parts of collisionEnergy.py."""
