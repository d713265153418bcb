# SPDX-License-Identifier: GPL-2.0-or-later
"""The present scene: its engines, saved states, time step, vertices of its bodies."""
