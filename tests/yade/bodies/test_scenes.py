# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene builders make the scenes that they document."""

import itertools

import numpy as np
import pytest
from boon2012.falling.scene import FallingPolyhedra, circumradiusOfUnitVolume
from boon2012.runWatch import RunWatch, stateHash
from yade import O

# of the solid of volume 1: circumradius, inradius and moment of inertia over mass
table = {
	4: (1.249025, 0.416342, 0.208008),
	6: (0.866025, 0.5, 0.166667),
	8: (0.908560, 0.524558, 0.165096),
	12: (0.710749, 0.564800, 0.156257),
	20: (0.733289, 0.582711, 0.155637),
}


@pytest.mark.parametrize('faces', table)
def testSolidsOfEqualVolume(faces):
	scene = FallingPolyhedra(faces=faces, number=3).build()
	circumradius, inradius, moment = table[faces]
	assert circumradiusOfUnitVolume(faces) == pytest.approx(circumradius, abs=1e-6)
	for body in scene.particles():
		assert len(body.shape.faces) == faces
		assert body.shape.volume == pytest.approx(1e-3, rel=1e-12) and body.state.mass == pytest.approx(2.6)
		assert body.shape.inscribedRadius == pytest.approx(0.1 * inradius, abs=1e-7)
		assert list(body.state.inertia) == pytest.approx([2.6 * 0.1**2 * moment] * 3, rel=1e-5)
		assert body.shape.cornerRadius == pytest.approx(0.01)


def testFullSceneIsTheDocumentedOne():
	scene = FallingPolyhedra(faces=4).build()
	assert len(O.bodies) == 205 and sum(b.dynamic for b in O.bodies) == 200
	assert O.dt == pytest.approx(2.884e-4, rel=1e-3)
	assert scene.width == pytest.approx(1.514, abs=1e-3)
	heights = sorted({round(b.state.pos[2], 9) for b in scene.particles()})
	assert len(heights) == 6 and heights[0] == pytest.approx(scene.spacing / 2 + 0.01)
	assert [sum(abs(b.state.pos[2] - h) < 1e-6 for b in scene.particles()) for h in heights] == [36] * 5 + [20]


def testNothingTouchesAtTheStart():
	scene = FallingPolyhedra(faces=4).build()
	O.step()
	assert scene.geometryFunctor.stats()['contacts'] == 0
	for wall in scene.wallIds + [scene.floorId]:
		assert not O.bodies[wall].dynamic
	reach = np.array([b.state.pos for b in scene.particles()])
	assert np.abs(reach[:, :2]).max() + 0.1249025 < scene.width / 2


def testSolidsTakeTurns():
	scene = FallingPolyhedra(faces=(4, 12, 20), number=7).build()
	assert [len(b.shape.faces) for b in scene.particles()] == [4, 12, 20, 4, 12, 20, 4]


def testSeedDecidesTheOrientations():
	hashes = []
	for seed in (1, 1, 2):
		FallingPolyhedra(number=5, seed=seed).build()
		hashes.append(stateHash())
	assert hashes[0] == hashes[1] != hashes[2]


def testOrientationsAreUniform():
	"""Over uniform rotations, the square of any component of any turned axis has mean 1/3."""
	scene = FallingPolyhedra(number=2000).build()
	turns = np.array([np.array(b.state.ori.toRotationMatrix()).reshape(3, 3) for b in scene.particles()])
	for row, column in itertools.product(range(3), repeat=2):
		assert np.mean(turns[:, row, column] ** 2) == pytest.approx(1 / 3, abs=0.03)


def testWatchCountsWhatTheFunctorCounts():
	"""The watch's clock runs in part of the steps; its counters are those of all."""
	scene = FallingPolyhedra(number=36).build()
	for _ in range(730):
		O.step()
	plain = scene.geometryFunctor.stats()
	scene = FallingPolyhedra(number=36).build()
	watch = RunWatch(scene.geometryFunctor, scene.interactionLoop)
	watch.run(400)
	watch.run(330)
	summary = watch.summary()
	assert summary['steps'] == O.iter == 730
	assert summary['pairs'] == plain['pairs'] and summary['contactQueries'] == plain['contacts'] > 0
	assert sum(summary['statuses'].values()) == summary['pairs']
	assert summary['lpMicroseconds'] > 0 and summary['centreMicroseconds'] > 0
	assert 0 < summary['loopMicrosecondsPerPair'] <= summary['loopMicrosecondsPerContact']
	assert not O.timingEnabled and not scene.geometryFunctor.timing
	assert summary['deepestOverlap'] >= summary['overlap'] > 0


@pytest.mark.parametrize('mostLost', [-np.inf, np.inf])  # every timed step counts as disturbed; none does
def testWatchHasTimesHoweverOftenAnotherProgramTakesTheProcessor(monkeypatch, mostLost):
	monkeypatch.setattr(RunWatch, 'mostLost', mostLost)
	scene = FallingPolyhedra(number=36).build()
	watch = RunWatch(scene.geometryFunctor, scene.interactionLoop)
	watch.run(730)
	assert (watch.disturbed if mostLost < 0 else watch.timed)['pairs'] > 0
	assert (watch.timed if mostLost < 0 else watch.disturbed)['pairs'] == 0
	assert watch.summary()['lpMicroseconds'] > 0 and watch.summary()['centreMicroseconds'] > 0


def testDismissedPairsCountForTheTimeOfTheLinearProgram():
	"""Bodies just above the floor are dismissed by the last step's weights; that takes time too."""
	scene = FallingPolyhedra(number=36).build()
	while not O.interactions.all():
		O.step()
	O.step()
	scene.geometryFunctor.resetStats()
	scene.geometryFunctor.timing = True
	O.step()
	stats = scene.geometryFunctor.stats()
	assert stats['dismissed'] == stats['pairs'] > 0 and stats['lpSeconds'] > 0


def testWallsAreHigherThanTheHighestLayer():
	assert FallingPolyhedra().wallHeight == 1.6
	assert FallingPolyhedra(number=100, columns=2).wallHeight > 25 * FallingPolyhedra().spacing
