# SPDX-License-Identifier: GPL-2.0-or-later
"""What help() and `?` show: values of defaults, and no markup; and names that scripts of plain Python have at hand."""

import inspect
import os
import pydoc
import re
import signal
import subprocess
import sys
import time

import pytest
import yade
from yade import polytope
from yade.polytope import _helpTexts, _sharedArguments

markup = re.compile(r'\.\. \w+::|:y?[a-z]+:`|::\w|\$|\]_|``')
"""Roles of Sphinx, C++ names, formulas of LaTeX, citations."""
ownMethods = {'make', 'nonFiniteForces', 'notedSignal', 'postpone', 'ratioSlidingContacts', 'resetStats', 'stats', 'watchSignals', 'write'}
"""Methods of the plug-in's classes; their signatures name Python's types alone."""


@pytest.mark.parametrize('name', _helpTexts.classes)
def testHelpOfClassesIsPlainText(name):
	one = getattr(yade, name)
	texts = [one.__doc__, *(member.__doc__ for key, member in vars(one).items() if isinstance(member, property) or key in ownMethods)]
	assert texts[0] and len(texts[0]) > 40
	for text in filter(None, texts):
		assert not markup.search(text), text


def testAllOfThePluginsClassesAreThere():
	"""The plug-in's classes are those whose name says so; what has been forgotten in the list would keep its markup."""
	ours = {name for name in dir(yade) if 'Polytope' in name or 'RockJoint' in name} | {'BaseMotion', 'QuietBoundary', 'VelocityHistory'}
	ours |= {'BartonBandisStrength', 'ContinuouslyYieldingStrength', 'HyperbolicClosure', 'PowerClosure'}
	assert ours - {'RockJointLawRelationships'} == set(_helpTexts.classes)  # that one is YADE's


def testDefaultsAreValues():
	assert 'Default: 9.99' in yade.Ig2_Polytope_Polytope_PolytopeGeom.tolerance.__doc__
	assert 'Default: inf.' in yade.PolytopeTimeStepper.maxDt.__doc__
	assert "Default: 'surface'." in yade.Ig2_Polytope_Polytope_PolytopeGeom.contactModel.__doc__
	assert 'τ' in yade.PolytopeTimeStepper.timestepSafetyCoefficient.__doc__


def testAttributesStillWork():
	functor = yade.Ig2_Polytope_Polytope_PolytopeGeom(tolerance=0.01)
	assert functor.tolerance == 0.01
	functor.tolerance = 0.02
	assert functor.tolerance == 0.02 and functor.dict()['tolerance'] == 0.02
	with pytest.raises(ValueError, match='tolerance'):
		functor.tolerance = -1
	with pytest.raises(AttributeError):
		yade.PolytopeGeom().infeasibility = 1


@pytest.mark.parametrize(
	'name', [name for name in polytope.__all__ if inspect.isroutine(getattr(polytope, name)) or inspect.isclass(getattr(polytope, name))]
)
def testHelpOfFunctionsIsPlainText(name):
	text = pydoc.plain(pydoc.render_doc(getattr(polytope, name)))
	assert not re.search(r':yref:`|polytope::|std::', text)


@pytest.mark.parametrize(
	'name',
	'fromHalfSpaces fromVertices regular cuboid polygon prism frustum fromMesh readShapes randomGrain grains plates tube terrain'.split(),
)
def testHelpOfBodiesHasTheSharedArguments(name):
	"""The help has each of them once, before what is returned and raised."""
	text = getattr(polytope, name).__doc__
	for argument in ('material', 'fixed', 'color', 'cornerRadius', 'velocity'):
		assert len(re.findall(rf'^:param (?:\w+ )?{argument}: ', text, re.MULTILINE)) == 1, argument
	own = set(inspect.signature(getattr(polytope, name)).parameters)
	assert all(len(re.findall(rf':param (?:\w+ )?{one}: ', text)) <= 1 for one in own)
	assert text.index(':param bool fixed: ') < text.index(':raises ')


def testSharedArgumentsOnesOwnComesFirst():
	shared = '\tOf all.\n\n\t:param int a: first\n\t    and more\n\t:param b: second\n'
	assert _sharedArguments.withShared('Does it.\n\n\t:param b: own\n\t:returns: it\n\t', shared, {'b'}) == (
		'Does it.\n\n:param b: own\n:param int a: first\n    and more\n:returns: it'
	)


def testPlain():
	assert _helpTexts.plain(r'Of $\tau=1/\omega_n$, see :yref:`this<Other.this>` [Boon2012]_. :ydefault:`a::b` :yattrtype:`Real`', 3.5) == (
		'Of τ=1/ω_n, see this [Boon2012]. Default: 3.5.'
	)


# ------------------------------------------------------------------------------------------------ plain Python


def python(script, folder):
	(folder / 'script.py').write_text(script)
	return subprocess.run([sys.executable, 'script.py'], cwd=folder, capture_output=True, text=True, timeout=600)


@pytest.mark.parametrize('imports', ['from yade import *\nfrom yade import polytope', 'from yade import polytope\nfrom yade import *'])
def testQuaternionAndVector3AreAtHand(imports, tmp_path):
	done = python(f'{imports}\nprint((Quaternion((0, 0, 1), 0) * Vector3(1, 2, 3))[2], O.iter)', tmp_path)
	assert done.stdout.endswith('3.0 0\n'), done.stdout + done.stderr


@pytest.mark.parametrize('name', ['hello.py', 'polygons.py', 'mesh.py', 'paraview.py'])
def testExamplesCanBeInterrupted(name, tmp_path):
	"""Ctrl-C, SIGINT, ends an example that runs, with Python's own message."""
	example = os.path.abspath(os.path.join(__file__, '../../../../examples', name))
	watched = f"""
import runpy, sys, threading, yade
def watch():
	import time
	while yade.O.iter < 50: time.sleep(0.01)
	print('runs', flush=True)
threading.Thread(target=watch, daemon=True).start()
sys.argv = [{example!r}]
runpy.run_path({example!r}, run_name='__main__')
"""
	(tmp_path / 'script.py').write_text(watched)
	process = subprocess.Popen([sys.executable, 'script.py'], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
	try:
		for line in process.stdout:
			if line.strip() == 'runs':
				break
		process.send_signal(signal.SIGINT)
		began = time.monotonic()
		_, said = process.communicate(timeout=300)
	finally:
		process.kill()
	assert 'KeyboardInterrupt' in said and process.returncode != 0, said
	assert time.monotonic() - began < 120
