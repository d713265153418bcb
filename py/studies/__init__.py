# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper's simulations are measured by: searches, cases, plots and reports, one file for each."""
