# SPDX-License-Identifier: GPL-2.0-or-later
"""Every test starts from an empty scene; scenes.py is importable from all of them."""
import os
import sys

os.environ.setdefault('OMP_WAIT_POLICY', 'passive')  # threads that wait do not take the core from those that work

import pytest
import yade

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))


@pytest.fixture(autouse=True)
def emptyScene():
	yade.O.reset()
	yield
	yade.O.reset()
