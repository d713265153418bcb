# SPDX-License-Identifier: GPL-2.0-or-later
"""What joins bodies: bonds of faces, bolts."""
