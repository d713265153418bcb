# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that are shaken: a base that moves as recorded, and boundaries that let waves out (docs/dynamics.md)."""
