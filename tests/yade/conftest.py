# SPDX-License-Identifier: GPL-2.0-or-later
"""Every test starts from an empty scene; scenes.py, the package boon2012 and the studies of accuracy are importable from all of them."""

import numbers
import os
import pathlib
import signal
import sys
import time

os.environ.setdefault('OMP_WAIT_POLICY', 'passive')  # waiting threads do not occupy the cores that working ones need

import pytest
import yade
from yade import polytope

# a shell that starts the tests in the background lets them, and the programs they start, ignore ctrl-C, which some of these are sent
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
	signal.signal(signal.SIGINT, signal.default_int_handler)

# Repeated in wider precisions than double, each file for what it alone compiles or computes differently there. What is left out repeats
# double's code with other scenes (the paper's simulations, studies, theory), or counts and compares runs with each other (bounds, threads,
# energies of the laws: test_precision has their scenes against 150 digits).
widePrecision = {
	'test_precision': "all quantities of a contact against references of more digits than double's",
	'test_plugin': 'loading, and the check of the layout of classes',
	'test_bodies': 'construction: conversions between Python, CGAL and Real',
	'test_spring': "the contact surface in Real, with YADE's own integrator",
	'test_contact_physics': "forces of every law in Real, and the paper's contact by them",
	'test_mixed_pairs': "YADE's spheres, walls, boxes and facets in Real",
	'test_rock_joint': 'the law, its state in Real',
	'test_save_load': 'archives of Real',
	'test_vtk': 'numbers written as double',
	'test_ipopt': 'Ipopt computes in double whatever Real is',
}
if polytope.buildInfo()['precision'] != 'double':
	# what pytest.approx asks of a number, and the messages of failures
	numbers.Real.register(yade.minieigenHP.Real)
	yade.minieigenHP.Real.__format__ = lambda self, how: format(float(self), how)
	here = pathlib.Path(__file__).resolve().parent
	collect_ignore = [str(path.relative_to(here)) for path in here.rglob('test_*.py') if path.stem not in widePrecision]

slowTests = {line.strip() for line in (pathlib.Path(__file__).parent / 'slow.txt').read_text().splitlines() if not line.startswith('#')}
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path += sorted(
	str(path) for path in pathlib.Path(__file__).resolve().parent.iterdir() if path.is_dir()
)  # tests may use those of other folders
# last: both have a report.py, which no test takes by its name
for folder in ('examples/paper', 'tools/measure/accuracy'):
	sys.path.append(os.path.abspath(os.path.join(__file__, '../../..', folder)))


def pytest_configure(config):
	config.addinivalue_line('markers', 'slow: left out by ./run test --fast; tests/yade/slow.txt lists them')


def pytest_collection_modifyitems(items):
	for item in items:
		if f'{item.path.name}::{getattr(item, "originalname", item.name)}' in slowTests:
			item.add_marker(pytest.mark.slow)


omega = type(yade.O)
startRun = omega.run


def runAndLookEveryMillisecond(self, nSteps=-1, wait=False):
	"""O.run, whose own `wait` looks only every 40 ms whether the run has ended: most of the time of short runs."""
	startRun(self, nSteps)
	if wait:
		while self.running:
			time.sleep(1e-3)
		self.wait()  # raises what ended the run


omega.run = runAndLookEveryMillisecond


@pytest.fixture(autouse=True)
def emptyScene():
	yade.O.reset()
	yield
	yade.O.reset()
	if 'yade.plot' in sys.modules:  # rows that polytope.history left
		sys.modules['yade.plot'].resetData()
