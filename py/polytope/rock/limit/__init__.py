# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit analysis of rigid blocks: forces that are in equilibrium and within the strengths of joints, or the motion with which the mass fails."""
