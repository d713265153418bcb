# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms that simulations are measured against: no YADE in here, NumPy and SciPy alone. One file for each problem."""
