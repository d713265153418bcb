# SPDX-License-Identifier: GPL-2.0-or-later
"""Common to the wedges of C and D: blocks cut by joints, their scene, closed forms, and the search for the critical friction angle."""
