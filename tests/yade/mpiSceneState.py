# SPDX-License-Identifier: GPL-2.0-or-later
"""What the scenes of mpiScenes.py share: how they are loaded and divided, and what is compared of them."""

import sys

import yade
from yade import O, polytope
from yade.polytope import mpi

folder = sys.argv[1]
solids, settling, steps = 24, 2500, 100
master = mpi.rank() == 0


def material():
	O.materials.append(yade.RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, dilationAngle=0.05))


def load(name='start'):
	mpi.merge()
	if master:
		O.load(f'{folder}/{name}.yade', quiet=True)
	mpi.divide()


def state():
	"""What the merged scene holds."""
	if not master:
		return None
	whole = lambda vector: [float(x).hex() for x in vector]
	return {
		'iter': O.iter,
		'time': O.time,
		'engines': len(O.engines),
		'coordination': polytope.coordinationNumber().mean,
		'mass': float(polytope.arrays().bodies.masses.sum()),
		'bodies': {
			b.id: [*whole(b.state.pos), *whole(b.state.ori), *whole(b.state.vel), *whole(b.state.angVel)]
			for b in O.bodies
			if b.dynamic and not b.isSubdomain
		},
		'contacts': {
			f'{i.id1} {i.id2}': [
				*whole(i.geom.normal),
				*whole(i.phys.normalForce),
				*whole(i.phys.shearForce),
				*whole(i.phys.slip),
				i.phys.dilation.hex(),
				i.phys.intact,
			]
			for i in O.interactions
			if i.isReal
		},
	}
