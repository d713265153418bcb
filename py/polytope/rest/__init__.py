# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes brought to rest, and what does not come to rest."""
