# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's contact and the conservative one: 200 polyhedra in a box without friction and damping, total energy over time.

	./run python examples/energy.py [STEPS]          writes energy.png and prints the energies at the end; 20 000 steps take some minutes

With the paper's model the energy changes by itself, because its averaged normal is no gradient of an energy; with
contactModel='conservative' it stays, to what the time step allows.
"""
import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '2')

from matplotlib.figure import Figure
from tqdm import tqdm
from yade import O
from yade.polytope.scenes import FallingPolyhedra
from yade.utils import kineticEnergy


def energies(model, steps, samples=200):
	"""Times [s] and total energies over that at the start, of one run."""
	scene = FallingPolyhedra(faces=(4, 6, 8, 12, 20), frictionAngle=0, contactDamping=0, damping=0, timeStepFraction=0.05).build()
	scene.geometryFunctor.contactModel = model
	O.trackEnergy = True
	times, values = [], []
	for _ in tqdm(range(samples), desc=model, disable=None):
		O.run(max(1, steps // samples), wait=True)
		height = sum(body.state.mass * scene.gravity * body.state.pos[2] for body in scene.particles())
		times.append(O.time)
		values.append(kineticEnergy() + height + dict(O.energy.items()).get('elastPotential', 0))
	return times, [value / values[0] for value in values]


steps = int(sys.argv[1]) if len(sys.argv) > 1 else 20000
figure = Figure(figsize=(9, 5), layout='constrained')
axes = figure.add_subplot(xlabel='time [s]', ylabel='total energy over that at the start')
for model in ('paper', 'conservative'):
	times, values = energies(model, steps)
	axes.plot(times, values, label=f"contactModel='{model}'")
	print(f'{model:14} {100 * (values[-1] - 1):+.3f} % after {times[-1]:.2f} s')
axes.legend()
figure.savefig('energy.png', dpi=130)
