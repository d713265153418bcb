# SPDX-License-Identifier: GPL-2.0-or-later
"""The running script: where it is, and how it ends. The same for `python SCRIPT` and `yade SCRIPT`."""

import pathlib
import sys

__all__ = ['conclude', 'scriptFile']


def scriptFile():
	"""Path of the script. `__file__` is that of YADE's own program when YADE executes a script."""
	return pathlib.Path(sys.argv[0]).resolve()


def conclude(findings):
	"""Writes and prints what was found; returns the script's exit code, 1 if something that must hold does not."""
	good = findings.save()
	findings.show()
	print(f'\nFiles: {findings.folder}/')
	return 0 if good else 1
