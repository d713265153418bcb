# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of matplotlib as files of a report."""

__all__ = ['saveFigure']


def saveFigure(path, figure):
	"""Writes the figure with no more room between its axes than labels need."""
	figure.tight_layout()
	figure.savefig(path, dpi=110)
