# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that break: along a plane, by their stress."""
