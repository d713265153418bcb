# SPDX-License-Identifier: GPL-2.0-or-later
"""Every test starts from an empty scene; scenes.py, the package boon2012 and the studies of accuracy are importable from all of them."""
import numbers
import os
import sys

os.environ.setdefault('OMP_WAIT_POLICY', 'passive')  # threads that wait do not take the core from those that work

import pytest
import yade
from yade import polytope

# In wider precisions than double, the tests of what depends on the numbers' kind: construction, contacts, laws, files,
# drawing. The others (the paper's simulations, studies, theory) repeat double's and take hours.
widePrecision = (
        'test_precision test_plugin test_bodies test_bounds test_conservative test_contact_physics test_contact_types test_energy test_mixed_pairs '
        'test_rock_joint test_save_load test_threads test_vtk test_ipopt'
).split()
if polytope.buildInfo()['precision'] != 'double':
	# what pytest.approx asks of a number, and the messages of failures
	numbers.Real.register(yade.minieigenHP.Real)
	yade.minieigenHP.Real.__format__ = lambda self, how: format(float(self), how)
	here = os.path.dirname(os.path.abspath(__file__))
	collect_ignore = [name for name in os.listdir(here) if name.startswith('test_') and name[:-3] not in widePrecision]

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
# last: both have a report.py, which no test takes by its name
for folder in ('examples/paper', 'tools/measure/accuracy'):
	sys.path.append(os.path.abspath(os.path.join(__file__, '../../..', folder)))


@pytest.fixture(autouse=True)
def emptyScene():
	yade.O.reset()
	yield
	yade.O.reset()
