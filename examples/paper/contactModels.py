# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact surface and the paper's contact on the paper's scenes: peak load of the three-hinged beam (B), critical friction angles of
the sliding and the roof wedge and of the slumping slope (C, D, E), energy that the two collisions gain (F), and settled heaps of polyhedra (A), beside
closed forms.

	./run python examples/paper/contactModels.py            # some minutes; table as output/contactModels/models.csv, too
	./run python examples/paper/contactModels.py --quick    # coarser friction steps, one small heap: two minutes
	./run python examples/paper/contactModels.py --only A --solids cube --seed 3
"""

import argparse
import csv
import math
import os
import pathlib
import types

os.environ.setdefault('OMP_NUM_THREADS', '1')

from boon2012.beam.scene import ThreeHingedBeam
from boon2012.beam.theory import BeamBetweenWalls, BeamOfTwoBlocks
from boon2012.collisions.scene import Collision
from boon2012.collisions.study import CollisionRun
from boon2012.falling.scene import FallingPolyhedra, solids
from boon2012.reporting.options import writableFolder
from boon2012.roofWedge.scene import RoofWedge
from boon2012.slidingWedge.study import limitEquilibrium
from boon2012.slope.scene import SlumpingSlope, readSlope
from boon2012.slope.theory import criticalFrictionAngle
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from boon2012.wedges.theory import roofWedgeFrictionAngle
from scipy.optimize import minimize_scalar
from tabulate import tabulate
from tqdm import tqdm
from yade import O, polytope
from yade.polytope.frictionReduction import FrictionReduction
from yade.utils import kineticEnergy

models = ('surface', 'boon2012')
"""Contact models that are compared."""
geometry = pathlib.Path(__file__).parent / 'geometry'
timeStep = 0.2
"""Time step over sqrt(mass / stiffness), of wedges and heaps."""
columns = 4
"""Columns of the heaps' starting lattice: some four layers of bodies lie on each other at the end."""
leastTime, mostTime, rest = 3.0, 10.0, 1e-4
"""A heap is at rest when its kinetic energy over N m g L is below *rest*, after the least time and every quarter of a second then [s]."""


def peakOfSpring(beam):
	"""Largest load [N] of the beam with the contact model *spring*, from its energy ½ k (6 W/V)² (src/contact/SurfaceContact.hpp). An edge
	on a face, and two edges that are mirror images, overlap in a polygon with an inscribed circle of radius r that touches all its sides:
	least slacks in it are a pyramid of that height, so with its area A: V = A r/3, W = A r²/12, U = ½ k (1.5 r)²."""

	def stored(turned):
		shared = beam.length * (math.cos(turned) - 1) + beam.height * math.sin(turned)
		c, s = math.cos(turned), math.sin(turned)

		def energy(behind):
			atWall, atMiddle = behind / (1 + c + s), (shared - behind) / (c + s)  # radii
			# of one half-beam: half of what is stored at midspan
			return 1.5**2 / 2 * (beam.abutmentStiffness * atWall**2 + beam.midspanStiffness * atMiddle**2 / 2)

		return minimize_scalar(energy, bounds=(0, shared), method='bounded', options={'xatol': 1e-14}).fun

	def load(turned, step=1e-4):
		return (stored(turned + step) - stored(turned - step)) / (2 * step) / (beam.length / 2)

	alignment = math.atan(beam.height / beam.length)
	return -minimize_scalar(lambda turned: -load(turned), bounds=(0.05 * alignment, alignment), method='bounded').fun


def beam(given):
	"""Rows: quantity, closed form, contact surface, the paper's; the load does not depend on --quick."""
	shape = {name: getattr(ThreeHingedBeam, name) for name in ('length', 'height', 'abutmentStiffness', 'midspanStiffness')}
	abutment = {name: getattr(ThreeHingedBeam, name) for name in ('abutmentHeight', 'abutmentLength')}
	for point, theory in (('centroid', BeamBetweenWalls(**shape)), ('analyticCentre', BeamOfTwoBlocks(**shape, **abutment))):
		yield f'B: peak load [N], {point}', theory.peak()[0], None, ThreeHingedBeam(contactPoint=point).build().peak().load
	scene = ThreeHingedBeam(contactModel='surface').build()
	yield 'B: peak load [N], from the energy', peakOfSpring(scene), scene.peak().load, None


def critical(scene, given):
	"""Critical friction angle [°] of a wedge that stands ready."""
	steps = (8, 1, 0.1, 0.02) if given.quick else (1, 0.1, 0.02, 0.005)
	reduction = FrictionReduction(
		[scene.wedgeId], math.radians(70), [math.radians(step) for step in steps], checkEvery=100, mostSteps=200000
	)
	result = reduction.run()
	reduction.restore()
	limit = polytope.stableTimeStep(2)
	if O.dt > limit:
		raise RuntimeError(f'the time step, {O.dt} s, is above the stable one, {limit} s')
	return math.degrees(result.critical)


def slidingWedge(given):
	blocks = BlockGeometry.read(geometry / 'c_sliding_wedge.json')

	def angle(model):
		scene = WedgeScene(blocks, timeStepFraction=timeStep, contactModel=model).build()
		scene.establishContacts()
		return critical(scene, given)

	yield 'C: critical angle [°]', math.degrees(limitEquilibrium(blocks).frictionAngle()), *each(angle, 'C')


def roofWedge(given):
	blocks = BlockGeometry.read(geometry / 'd_roof_wedge.json')

	def angle(model, pressed):
		nonlocal closed
		scene = RoofWedge(blocks, timeStepFraction=timeStep, contactModel=model).build()
		if pressed:
			scene.pressByBoundary()
		else:
			scene.setJointForces()
		force = scene.horizontalStress * sum(joint.area * math.cos(a) for joint, a in zip(scene.joints, scene.inclinations, strict=True))
		closed = math.degrees(roofWedgeFrictionAngle(scene.weight, force, scene.inclinations[0]))
		return critical(scene, given)

	closed = None
	for pressed, way in ((False, 'joint forces set'), (True, 'boundary stress')):
		found = each(lambda model, pressed=pressed: angle(model, pressed), f'D, {way}')
		yield f'D: critical angle [°], {way}', closed, *found


def slumpingSlope(given):
	blocks = readSlope(geometry / 'e_slope.json')
	steps = (5, 1, 0.25) if given.quick else (5, 1, 0.25, 0.05)

	def angle(model):
		scene = SlumpingSlope(**blocks, contactModel=model).build()
		reduction = FrictionReduction(
			scene.freeIds,
			start=scene.frictionAngle,
			steps=[math.radians(step) for step in steps],
			checkEvery=100,
			stableSpeed=1e-6,
			failedDistance=0.1,
			mostSteps=100000,
		)
		return math.degrees(reduction.run().critical)

	limit = math.degrees(criticalFrictionAngle(blocks['free'], blocks['fixed']).angle)
	yield 'E: critical angle [°]', limit, *each(angle, 'E')


def collisions(given):
	"""What the contact gives to the motion: no closed form but zero."""
	blocks = {
		'geometry': geometry / 'f_collisions.json',
		'density': Collision.density,
		'normal_stiffness': Collision.normalStiffness,
		'shear_stiffness': Collision.shearStiffness,
		'friction': Collision.frictionCoefficient,
		'contact_damping': Collision.contactDamping,
		'damping': Collision.damping,
		'damp_gravity': Collision.dampGravity,
		'gravity': Collision.gravity,
		'corner_radius': Collision.cornerRadius,
		'time_step': Collision.timeStep,
		'contact_point': Collision.contactPoint,
	}
	for name, label in (('vertexFace', 'F1'), ('edgeEdge', 'F2')):
		found = each(
			lambda model, name=name: CollisionRun(types.SimpleNamespace(**blocks), name, contactModel=model).largestRise()[0], label
		)
		yield f'F: largest rise of energy in 200 steps [J], {label}', 0, *found


def heap(faces, model, given):
	"""A settled heap: (porosity, Coordination, time [s], kinetic energy over N m g L)."""
	number = 100 if given.quick else 200
	lattice = {'columns': 3 if given.quick else columns, 'number': number, 'seed': given.seed}
	scene = FallingPolyhedra(faces=faces, timeStepFraction=timeStep, **lattice).build()
	scene.geometryFunctor.contactModel = model
	size, particles = scene.size, scene.particles()
	O.run(round(leastTime / O.dt), wait=True)
	unit = number * scene.mass * scene.gravity * size
	while kineticEnergy() > rest * unit and O.time < mostTime:
		O.run(round(0.25 / O.dt), wait=True)
	height = sum(body.state.pos[2] for body in particles) / number
	side = scene.width / 2 - size
	box = (-side, -side, size / 2), (side, side, max(1.5 * height, size))
	return polytope.porosity(*box), polytope.coordinationNumber(), O.time, kineticEnergy() / unit


def heaps(given):
	for name in given.solids:
		found = each(lambda model, solid=solids[name]: heap(solid, model, given), f'A, {name}')
		yield f'A: porosity, {name}', None, *[one[0] for one in found]
		yield f'A: coordination number, {name}', None, *[one[1].mean for one in found]
		yield f'A: the same without rattlers, {name}', None, *[one[1].mechanical for one in found]
		yield f'A: rattlers, {name}', None, *[one[1].rattlers for one in found]
		yield f'A: time [s], {name}', None, *[one[2] for one in found]
		yield f'A: kinetic energy / (N m g L), {name}', None, *[one[3] for one in found]


def each(measure, label):
	return [measure(model) for model in tqdm(models, label, leave=False, disable=None)]


parts = {'B': beam, 'C': slidingWedge, 'D': roofWedge, 'E': slumpingSlope, 'F': collisions, 'A': heaps}


def main():
	parser = argparse.ArgumentParser(
		description=' '.join(__doc__.split('\n\n')[0].split()), formatter_class=argparse.ArgumentDefaultsHelpFormatter
	)
	parser.add_argument('--quick', action='store_true', help='coarser friction steps, 100 bodies instead of 200, cubes alone')
	parser.add_argument('--only', choices=parts, nargs='+', default=list(parts))
	parser.add_argument('--solids', choices=solids, nargs='+', help='of the heaps; None: all, quick: cubes')
	parser.add_argument('--seed', type=int, default=1, help="of the heaps' orientations")
	parser.add_argument('--output', type=writableFolder, default=pathlib.Path('output/contactModels'), help='folder of the table')
	given = parser.parse_args()
	given.solids = given.solids or (['cube'] if given.quick else list(solids))
	head = ['quantity', 'closed form', 'contact surface (default)', "the paper's"]
	rows = [row for name in given.only for row in parts[name](given)]
	print(tabulate(rows, head, floatfmt='.6g', missingval=''))
	given.output.mkdir(parents=True, exist_ok=True)
	with open(given.output / 'models.csv', 'w', newline='') as file:
		csv.writer(file).writerows([head, *rows])


if __name__ == '__main__':
	main()
