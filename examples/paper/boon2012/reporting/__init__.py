# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper's scripts, and the programs of tools/measure, report with: findings, options, runs of several scripts, one page."""
