# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks and grains on joints, where theory has one answer: the parts of joints.py."""
