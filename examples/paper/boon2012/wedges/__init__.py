# SPDX-License-Identifier: GPL-2.0-or-later
"""What the wedges of C and D share: blocks cut by joints, their scene, closed forms, and the search for the critical friction angle."""
