# SPDX-License-Identifier: GPL-2.0-or-later
"""Smoothness of the contact along a path: the parts of contactPath.py."""
