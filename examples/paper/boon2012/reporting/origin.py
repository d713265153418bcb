# SPDX-License-Identifier: GPL-2.0-or-later
"""What results belong to: revision of the sources, machine, date."""

import datetime
import os
import pathlib
import platform
import subprocess

__all__ = ['origin']


sources = pathlib.Path(__file__).resolve().parents[4]


def origin(project=sources):
	"""Recorded when a run begins.

	:param project: folder of the sources
	:returns: dictionary of JSON's types: *revision* (40 digits; '-dirty' after them where sources differ from it; 'unknown' without git), *date*
	        (UTC), *machine*, *cores*, *load* (mean number of processes that ran in the minute before)
	"""
	git = ['git', '-c', f'safe.directory={project}', '-C', str(project), 'describe', '--always', '--abbrev=40', '--dirty', '--exclude=*']
	try:
		revision = subprocess.run(git, capture_output=True, text=True).stdout.strip()
	except OSError:
		revision = ''
	return {
		'revision': revision or 'unknown',
		'date': datetime.datetime.now(datetime.UTC).strftime('%Y-%m-%d'),
		'machine': processor(),
		'cores': os.cpu_count(),
		'load': round(os.getloadavg()[0], 2),
	}


def processor():
	"""Name of the processor, as the system has it."""
	try:
		with open('/proc/cpuinfo') as file:
			names = [line.split(':', 1)[1].strip() for line in file if line.startswith('model name')]
	except OSError:
		names = []
	return names[0] if names else platform.processor() or platform.machine()
