# SPDX-License-Identifier: GPL-2.0-or-later
"""The example of a normal law of one's own: in all that a scene shows it is the plug-in's own hyperbola."""

import pytest
from test_extensions import built, inYade, project


@pytest.fixture(scope='module')
def hyperbola():
	return built('hyperbolicJoint')


scene = """
from yade import polytope, Vector3
import math
def scene(closure, **more):
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=2e8, shearStiffness=1e8, frictionAngle=0.5, closure=closure(maximumClosure=4e-4), **more))
	tilt = Quaternion((1, 0, 0), 0.3)
	O.bodies.append(polytope.cuboid(center=tilt * Vector3(0, 0, -0.5), orientation=tilt, extents=(2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid(center=tilt * Vector3(0, 0, 0.5 + 1e-3), orientation=tilt, extents=(0.5, 0.4, 0.5)))
	O.trackEnergy = True
	O.engines = polytope.engines()
def state():
	c, s = O.interactions[0, 1], O.bodies[1].state
	numbers = [*s.pos, *s.vel, *s.angVel, *c.phys.normalForce, *c.phys.shearForce, c.phys.kn, c.phys.ks, O.dt, *(v for _, v in sorted(O.energy.items()))]
	return [float(x) for x in numbers]
"""


def testItIsThePlugInsHyperbolaInAllThatASceneShows(hyperbola, tmp_path):
	"""A block that falls onto a slope: motion, forces, stiffness, time step, energies; and on from a scene that was saved, in a new process."""
	saved = tmp_path / 'scene.yade.bz2'
	script = (
		'polytope.load(sys.argv[1])\nseen = []\nfor closure in (HyperbolicClosure, OwnHyperbola):\n\tscene(closure)\n\tO.run(600, True)\n'
		'\tseen.append(state())\nO.save(sys.argv[2])\nO.run(100, True)\nanswer([seen, state(), O.interactions.countReal()])\n'
	)
	(seen, later, contacts), _ = inYade(scene + script, hyperbola, saved)
	assert contacts == 1
	assert seen[1] == pytest.approx(seen[0], rel=1e-9, abs=1e-9)
	assert seen[1][9:12] != [0, 0, 0]
	again, _ = inYade(scene + 'O.load(sys.argv[1])\nO.run(100, True)\nanswer(state())\n', saved, YADE_POLYTOPE_EXTENSIONS=str(hyperbola))
	assert again == pytest.approx(later, rel=1e-9, abs=1e-9)


@pytest.fixture(scope='module')
def wrong():
	"""A library whose law has the name of the example's, and an energy that is not the integral of its pressure."""
	text = (project / 'examples/extend/hyperbolicJoint/hyperbolicJoint.cpp').read_text()
	other = (
		text.replace('class OwnHyperbola', 'class OtherHyperbola')
		.replace('(OwnHyperbola', '(OtherHyperbola')
		.replace('~OwnHyperbola', '~OtherHyperbola')
	)
	changed = other.replace('beyond / 2 /', 'beyond / 3 /')
	assert '"OwnHyperbola"' in changed and changed != other != text
	return built('hyperbolicJoint', 'wrong', hyperbolicJoint=changed)


def testALawThatDoesNotFitTogetherIsRefused(wrong):
	"""When a material is to have it: the sentence names the law, its parameters and what is wrong; nothing is changed."""
	script = """
from yade import polytope
polytope.load(sys.argv[1])
material = RockJointMat(normalStiffness=2e8)
def said(call):
	try: call()
	except ValueError as error: return str(error)
def give(): material.closure = OtherHyperbola(maximumClosure=4e-4)
answer([said(give), said(lambda: RockJointMat(closure=OtherHyperbola(maximumClosure=4e-4))), material.closure is None])
"""
	(given, made, none), _ = inYade(script, wrong)
	begin = 'closure: the normal law OwnHyperbola (p = 0.0004, q = 0): its energy is not the integral of its pressure: from '
	assert given.startswith(begin) and made.startswith(begin) and none is True


def testCheckLooksAtParametersThatWereChangedLater(hyperbola):
	script = (
		scene
		+ """
polytope.load(sys.argv[1])
scene(OwnHyperbola)
before = [one.what for one in polytope.check(O)]
O.materials[0].closure.maximumClosure = float('nan')
answer([before, [[one.what, one.seen] for one in polytope.check(O)]])
"""
	)
	(before, after), _ = inYade(script, hyperbola)
	assert before == []
	assert any(
		what == 'joint laws' and 'the normal law OwnHyperbola (p = nan, q = 0): pressure, tangent and energy must be finite' in seen
		for what, seen in after
	), after


def testANameThatALawHasIsRefused(hyperbola, wrong):
	"""polytope.load refuses it, and so does the start, after which YADE goes on with the law that was there."""
	script = """
from yade import polytope
polytope.load(sys.argv[1])
try: polytope.load(sys.argv[2])
except ValueError as error: text = str(error)
answer([text, hasattr(yade, 'OtherHyperbola'), len(polytope.extensions()), RockJointMat(closure=OwnHyperbola(maximumClosure=1e-3)).closure.maximumClosure])
"""
	(text, *rest), _ = inYade(script, hyperbola, wrong)
	reason = 'there is a normal law OwnHyperbola already: give this one another name'
	assert text == f'path: the extension {wrong} is not loaded: {reason}' and rest == [False, 1, 1e-3]
	known, warning = inYade(
		'answer([hasattr(yade, "OwnHyperbola"), hasattr(yade, "OtherHyperbola")])', YADE_POLYTOPE_EXTENSIONS=f'{hyperbola}:{wrong}'
	)
	assert known == [True, False] and f'WARNING: the extension {wrong} is not loaded: {reason}.' in warning
