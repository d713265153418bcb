# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and films of a scene."""
