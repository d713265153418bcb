# SPDX-License-Identifier: GPL-2.0-or-later
"""The simulations of Boon, Houlsby & Utili (2012), Computers and Geotechnics 44:73-82: scenes, closed forms, studies and reports.

One folder a simulation; the scripts beside this package run them. Within a folder: scene.py builds it, theory.py has the closed forms it is
measured against (no YADE in there, NumPy and SciPy alone), study.py or run.py runs it, plots.py and report.py show the results. Shared:
*reporting* (findings, options of the scripts, one report of several), *wedges* (of C and D), runWatch, solverTimes.

Not part of the installed module yade.polytope, which imports nothing from here.
"""
