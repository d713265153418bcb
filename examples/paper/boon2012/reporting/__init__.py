# SPDX-License-Identifier: GPL-2.0-or-later
"""Reporting of the paper's scripts and of the programs of tools/measure: findings, options, runs of several scripts, one page."""
