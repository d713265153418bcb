# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies: one, of parts, of meshes and files, random grains, packings, containers."""
