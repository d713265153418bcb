# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation E of Boon, Houlsby & Utili (2012): a rock slope whose joints do not daylight fails as its outer layer turns backward (Fig. 11).

Blocks between bedding that dips as the face and cross joints that dip into the slope; base and back are fixed. No block can slide out,
even without friction. The script settles the slope, lowers the friction angle until a block has moved by more than 0.1 m, and finds
the angle at which that happens; it then lets the slope fail and counts the types of contacts on the way. Beside it stands a limit
analysis (static theorem, linear programme) with its mechanism: 19.75° for the geometry given here, the outer layer alone, its
lower five blocks turning backward as one. Expected here: a failure between 19° and 22.5°, by the same mechanism.
Ends with 1 if the angle, the mode or the analysis is not as expected, or a contact query had no answer.

	./run python examples/paper/e_slumping_slope.py            # two minutes, most of them for the table of other settings
	./run python examples/paper/e_slumping_slope.py --quick    # coarser steps, no table; half a minute
	./run python examples/paper/e_slumping_slope.py --geometry other.json --corner-radius 0.01 --steps 1 0.2 --output other

A geometry file has corners of polygons: {"free": [[[x, y], …], …], "fixed": […], "params": {"delta": dip [°], "s": bedding spacing [m]}}.
"""
import argparse
import math
import os
import pathlib
import sys

folder = pathlib.Path(__file__).resolve().parent
contactPoints = ('analyticCentre', 'chebyshevCentre', 'centroid')
# names of polygons' contacts → of the prisms they stand for
prismTypes = {'edge-edge': 'face–face', 'vertex-edge': 'edge–face', 'vertex-vertex': 'edge–edge'}
typeColors = {'face–face': '#3380a8', 'edge–face': '#86bcbb', 'edge–edge': '#f2a541'}

acceptedAngles = (19, 22.5)
"""Of the reference geometry [°]: independent programs with vertex springs and of the paper's algorithm failed from 19.5° to 21.5°."""
mostInnerMotion = 0.02
"""Of the inner layers when the slope has failed [m]."""
limitAngle, limitTolerance = 19.75, 0.005
collapse = 1.0
"""Motion at which the record of the failure ends [m]."""
sampleSteps = 100


def options():
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	positive, fraction = number(above=0), number(least=0)
	parser.add_argument('--geometry', type=pathlib.Path, default=folder / 'geometry/e_slope.json')
	parser.add_argument('--density', type=positive, default=2500., help='[kg/m³]')
	parser.add_argument('--normal-stiffness', type=positive, default=1e9, help='of the joints [Pa/m]')
	parser.add_argument('--shear-stiffness', type=positive, default=1e9, help='of the joints [Pa/m]')
	parser.add_argument('--stiffness-per-contact', action='store_true', help='stiffnesses are [N/m] for each contact, whatever its area')
	parser.add_argument('--gravity', type=positive, default=10., help='[m/s²]')
	parser.add_argument('--contact-damping', type=fraction, default=0.1, help='fraction of critical, normal and shear')
	parser.add_argument('--damping', type=number(least=0, below=1), default=0.3, help="YADE's own (NewtonIntegrator.damping)")
	parser.add_argument('--corner-radius', type=positive, default=0.05, help='of all blocks, and tolerance of the contact types [m]')
	parser.add_argument('--time-step', type=positive, default=1e-4, help='[s]')
	parser.add_argument('--contact-point', choices=contactPoints, default='analyticCentre')
	parser.add_argument('--start', type=number(above=0, below=90), help='friction angle to settle at [°] (default: 40; 26 with --quick)')
	parser.add_argument('--steps', type=positive, nargs='+', help='reductions of the friction angle, coarse to fine [°] (default: 1 0.1; 1 0.25 with --quick)')
	parser.add_argument('--failed-distance', type=positive, default=0.1, help='motion of a block that counts as failure [m]')
	parser.add_argument('--stable-speed', type=positive, default=1e-6, help='below it for three looks in turn a state is stable [m/s]')
	parser.add_argument('--most-steps', type=int, default=100000, help='of one friction angle; not at rest by then counts as failure')
	parser.add_argument('--quick', action='store_true', help='coarser steps, no table of other settings')
	parser.add_argument('--output', type=pathlib.Path, default=pathlib.Path('output/e_slumping_slope'), help='folder for all files')
	parser.add_argument('--no-pictures', action='store_true', help='no pictures of the blocks (plots are made)')
	given = parser.parse_args()
	given.reference = given.geometry == parser.get_default('geometry')
	given.start = given.start or (26. if given.quick else 40.)
	given.steps = given.steps or ([1., 0.25] if given.quick else [1., 0.1])
	if any(a <= b for a, b in zip(given.steps, given.steps[1:])):
		parser.error('--steps must become smaller')
	if given.most_steps < 1000:
		parser.error('--most-steps must be at least 1000')
	if not given.geometry.is_file():
		parser.error(f'--geometry: there is no file {given.geometry}')
	return parser, given


def number(above=None, least=None, below=None):
	def parse(text):
		value = float(text)
		if not math.isfinite(value) or above is not None and value <= above or least is not None and value < least or below is not None and value >= below:
			limits = [f'above {above:g}' if above is not None else '', f'at least {least:g}' if least is not None else '', f'below {below:g}' if below is not None else '']
			raise argparse.ArgumentTypeError(f"must be {' and '.join(x for x in limits if x)}, got {text}")
		return value
	parse.__name__ = 'number'
	return parse


def build(given, geometry, **changes):
	from yade.polytope.scenes import SlumpingSlope
	settings = dict(
	        density=given.density,
	        normalStiffness=given.normal_stiffness,
	        shearStiffness=given.shear_stiffness,
	        stiffnessPerArea=not given.stiffness_per_contact,
	        gravity=given.gravity,
	        contactDamping=given.contact_damping,
	        damping=given.damping,
	        cornerRadius=given.corner_radius,
	        timeStep=given.time_step,
	        contactPoint=given.contact_point,
	        frictionAngle=math.radians(given.start)
	)
	return SlumpingSlope(**geometry, **{**settings, **changes}).build()


def reduce(given, scene, label, steps=None, failedDistance=None):
	"""Runs the friction reduction; returns (FrictionReduction, its result)."""
	from tqdm import tqdm
	from yade.polytope.contactTypes import ContactTypes
	from yade.polytope.frictionReduction import FrictionReduction
	types = ContactTypes(scene.cornerRadius)
	with tqdm(desc=label, unit=' looks', disable=None) as bar:
		def progress(stage):
			bar.set_postfix_str(f'{math.degrees(stage.angle):.2f}°, {1e3 * stage.displacement:.1f} mm, {stage.speed:.0e} m/s', refresh=False)
			bar.update()
		reduction = FrictionReduction(
		        scene.freeIds,
		        start=math.radians(given.start),
		        steps=[math.radians(step) for step in steps or given.steps],
		        stableSpeed=given.stable_speed,
		        failedDistance=failedDistance or given.failed_distance,
		        checkEvery=sampleSteps,
		        mostSteps=given.most_steps,
		        measure=lambda: (blockStates(scene), types.count()),
		        progress=progress
		)
		return reduction, reduction.run()


def blockStates(scene):
	"""(blocks, 3): centre [m] and orientation [rad] of each free block."""
	import numpy as np
	rows = []
	for body in scene.bodies():
		axis, turn = body.state.ori.toAxisAngle()
		rows.append([body.state.pos[0], body.state.pos[1], axis[2] * turn])
	return np.array(rows)


class Watch:
	"""What the blocks do while the slope fails: one sample every `sampleSteps` steps, motions are those since *origin* (blockStates)."""

	def __init__(self, scene, tolerance, origin):
		from yade.polytope.contactTypes import ContactTypes
		self.scene, self.types, self.origin = scene, ContactTypes(tolerance), origin
		self.time, self.angle, self.motion, self.counts, self.speed = [], [], [], [], []

	def change(self):
		"""Motion since the origin; turns between −π and π."""
		import numpy as np
		change = blockStates(self.scene) - self.origin
		change[:, 2] = (change[:, 2] + np.pi) % (2 * np.pi) - np.pi
		return change

	def sample(self, angle):
		from yade import O
		self.time.append(O.time)
		self.angle.append(angle)
		self.motion.append(self.change())
		self.speed.append(max(body.state.vel.norm() for body in self.scene.bodies()))
		self.counts.append(self.types.count())

	def displacement(self):
		"""(samples, blocks) [m]."""
		import numpy as np
		return np.linalg.norm(np.array(self.motion)[:, :, :2], axis=2)

	def rotation(self):
		"""(samples, blocks) [°], counter-clockwise."""
		import numpy as np
		return np.degrees(np.array(self.motion)[:, :, 2])

	def contacts(self):
		"""(samples, 3): numbers of face–face, edge–face and edge–edge contacts."""
		import numpy as np
		return np.array([[count[name] for name in prismTypes] for count in self.counts])


def watchFailure(given, scene, result):
	"""From the last stable state: friction at which it fails, then half a degree less each time it comes to rest, until a block has moved by `collapse`."""
	from tqdm import tqdm
	from yade import O
	from yade.polytope.frictionReduction import setFrictionAngle
	watch = Watch(scene, given.corner_radius, result.stages[0].measured[0])  # as it had settled
	angle, calm = result.failed, 0
	watch.sample(result.stable)
	setFrictionAngle(angle)
	with tqdm(total=collapse, desc='failure', unit=' m', bar_format='{desc}: {n:.2f} of {total} m [{elapsed}]', disable=None) as bar:
		for _ in range(3 * given.most_steps // sampleSteps):
			for _ in range(sampleSteps):
				O.step()
			watch.sample(angle)
			moved = watch.displacement()[-1].max()
			bar.update(min(moved, collapse) - bar.n)
			if moved > collapse:
				break
			calm = calm + 1 if watch.speed[-1] < given.stable_speed else 0
			if calm == 3:
				angle, calm = angle - math.radians(0.5), 0
				setFrictionAngle(max(angle, 0.0))
	return watch


def limitAnalysis(given, geometry, findings, layers):
	"""Rows of the static theorem; returns its LimitState."""
	import numpy as np
	from yade.polytope.theory.slope import criticalFrictionAngle
	limit = criticalFrictionAngle(geometry['free'], geometry['fixed'])
	angle = math.degrees(limit.angle)
	findings.row(
	        'critical friction angle, limit analysis', angle, '°', theory=limitAngle if given.reference else None,
	        accept=(limitAngle - limitTolerance, limitAngle + limitTolerance) if given.reference else None, note='static theorem; theory: an independent linear programme'
	)
	sliding = math.degrees(criticalFrictionAngle(geometry['free'], geometry['fixed'], rotations=False).angle)
	findings.row(
	        'the same if no block could turn', sliding, '°', theory=0 if given.reference else None, accept=(0, 0) if given.reference else None,
	        note='0: there is no translational mechanism even without friction'
	)
	moving = np.abs(limit.velocities).max(axis=1) > 1e-6
	outer = np.array(layers) == 0
	inner = int(np.count_nonzero(moving & ~outer))
	findings.row('mechanism: inner blocks that move', inner, '', theory=0 if given.reference else None, accept=(0, 0) if given.reference else None)
	spins = limit.velocities[outer, 2]
	together = 0
	while together < len(spins) and abs(spins[together] - spins[0]) < 1e-6 * abs(spins[0]):
		together += 1
	findings.row(
	        'mechanism: lowest outer blocks that turn as one', together, '', theory=5 if given.reference else None, accept=(5, 5) if given.reference else None,
	        note=f'spins of the outer layer over the lowest one, from below: {", ".join(f"{spin / spins[0]:.3f}" for spin in spins) if spins[0] else "none"}; clockwise, that is backward: {bool((spins <= 0).all())}'
	)
	return limit


def drawBlocks(path, scene, **picture):
	import numpy as np
	from yade.polytope import pictures
	corners = np.concatenate([np.array(points, float) for points in scene.free])
	low, high = corners.min(axis=0) - (2.5, 1.2), corners.max(axis=0) + (1.0, 0.6)
	frame = [(x, y, 0) for x in (low[0], high[0]) for y in (low[1], high[1])]
	pictures.picture(path, frame=frame, size=(1000, 800), **picture)


def drawFailure(path, parts):
	"""Pictures side by side, with titles."""
	import matplotlib.pyplot as plt
	from matplotlib.image import imread
	figure, axes = plt.subplots(1, len(parts), figsize=(6.3 * len(parts), 5.4))
	for axis, (part, title) in zip(axes, parts, strict=True):
		axis.imshow(imread(part))
		axis.set_title(title)
		axis.axis('off')
	figure.tight_layout()
	figure.savefig(path, dpi=110)
	plt.close(figure)


def plotMechanism(path, geometry, limit, motion):
	"""Velocities of the limit analysis beside the motion at failure: blocks moved by both, enlarged."""
	import matplotlib.pyplot as plt
	import numpy as np
	from yade.polytope.theory.slope import centroid
	figure, axes = plt.subplots(1, 2, figsize=(12, 5.4), sharex=True, sharey=True)
	motion = motion / np.linalg.norm(motion[:, :2], axis=1).max()
	analysis = limit.velocities / max(np.linalg.norm(limit.velocities[:, :2], axis=1).max(), 1e-300)
	for axis, moves, title in zip(axes, (analysis, motion), ('limit analysis', 'at failure'), strict=True):
		for corners in geometry['fixed']:
			axis.add_patch(plt.Polygon(corners, facecolor='#dbdbd7', edgecolor='none'))
		for corners, (x, y, turn) in zip(geometry['free'], moves, strict=True):
			corners = np.array(corners)
			arms = corners - centroid(corners)[1]
			moved = corners + 0.8 * (np.array([x, y]) + turn * np.column_stack([-arms[:, 1], arms[:, 0]]))
			axis.add_patch(plt.Polygon(corners, facecolor='none', edgecolor='#b0b0b0', lw=0.6))
			axis.add_patch(plt.Polygon(moved, facecolor='#3380a8' if abs(turn) > 0.05 * np.abs(moves[:, 2]).max() else '#f0e4ba', edgecolor='#222222', lw=0.8, alpha=0.8))
		axis.set_title(f'{title}: motion enlarged to 0.8 m')
		axis.set_xlabel('x [m]')
		axis.set_aspect('equal')
	corners = np.concatenate([np.array(points) for points in geometry['free']])
	axes[0].set_xlim(corners[:, 0].min() - 2, corners[:, 0].max() + 1)
	axes[0].set_ylim(corners[:, 1].min() - 1, corners[:, 1].max() + 1)
	axes[0].set_ylabel('y [m]')
	figure.tight_layout()
	figure.savefig(path, dpi=110)
	plt.close(figure)


def plotReduction(path, result, limit):
	import matplotlib.pyplot as plt
	figure, axis = plt.subplots(figsize=(7.5, 4.5))
	for outcome, mark, color in (('stable', 'o', '#1d4e79'), ('failed', 'x', '#c8451b'), ('creeping', '+', '#f2a541')):
		stages = [stage for stage in result.stages[1:] if stage.outcome == outcome]  # the first one is the settling
		if stages:
			axis.semilogy([math.degrees(s.angle) for s in stages], [1e3 * s.displacement for s in stages], mark, color=color, label=outcome)
	axis.axvline(math.degrees(limit.angle), color='#222222', lw=0.8, ls='--', label='limit analysis')
	axis.set_xlabel('friction angle [°]')
	axis.set_ylabel('largest motion since settling [mm]')
	axis.legend(frameon=False)
	figure.tight_layout()
	figure.savefig(path, dpi=110)
	plt.close(figure)


def plotFailure(path, watch, layers):
	"""Motion and rotation of the blocks, and the numbers of contacts of each type, while the slope fails."""
	import matplotlib.pyplot as plt
	import numpy as np
	time = np.array(watch.time) - watch.time[0]
	displacement, rotation, contacts = watch.displacement(), watch.rotation(), watch.contacts()
	outer = np.array(layers) == 0
	figure, axes = plt.subplots(4, 1, figsize=(9, 12), sharex=True)
	shades = plt.get_cmap('viridis')(np.linspace(0, 0.9, outer.sum()))
	for k, (block, color) in enumerate(zip(np.flatnonzero(outer), shades, strict=True)):
		axes[0].plot(time, 1e3 * displacement[:, block], color=color, label=f'outer block {k + 1}')
		axes[1].plot(time, rotation[:, block], color=color)
	axes[0].plot(time, 1e3 * displacement[:, ~outer].max(axis=1, initial=0), color='#c8451b', ls='--', label='most of inner blocks')
	for block in np.flatnonzero(~outer):
		axes[1].plot(time, rotation[:, block], color='#c8451b', ls='--', lw=0.6)
	axes[0].set_ylabel('motion since settling [mm]')
	axes[0].legend(frameon=False, ncol=2)
	axes[1].set_ylabel('rotation [°]\n(negative: backward)')
	for k, (name, color) in enumerate(typeColors.items()):
		axes[2].plot(time, contacts[:, k], color=color, label=name, lw=1.8)
	axes[2].set_ylabel('contacts')
	axes[2].legend(frameon=False, ncol=3)
	axes[3].plot(time, np.degrees(watch.angle), color='#222222', drawstyle='steps-pre')
	axes[3].set_ylabel('friction angle [°]')
	axes[3].set_xlabel('time since the last stable state [s]')
	figure.tight_layout()
	figure.savefig(path, dpi=110)
	plt.close(figure)


def settingsTable(given, geometry, findings):
	"""The critical angle with other settings, and the limit analysis with joints whose ends are worn off by the corner radius."""
	from yade import O
	from yade.polytope.theory.slope import criticalFrictionAngle
	radius, step, stiffness = given.corner_radius, given.time_step, given.normal_stiffness
	stiffer = {'normalStiffness': 2 * stiffness, 'shearStiffness': 2 * given.shear_stiffness, 'timeStep': step / math.sqrt(2)}
	cases = [
	        ('as given', {}, {}), *((f'corner radius {factor * radius:g} m', {'cornerRadius': factor * radius}, {}) for factor in (0.2, 0.4, 2)),
	        ('half the time step', {'timeStep': step / 2}, {}), ('twice the stiffness', stiffer, {}),
	        *((f'contact point {point}', {'contactPoint': point}, {}) for point in contactPoints if point != given.contact_point),
	        ('YADE damping 0.7', {'damping': 0.7}, {}), ('YADE damping 0, contact damping 0.3', {'damping': 0., 'contactDamping': 0.3}, {}),
	        ('failure at 20 mm', {}, {'failedDistance': 0.02}), ('friction step 0.5° instead of 1°', {}, {'steps': [0.5, 0.25]})
	]  # yapf: disable
	rows = []
	for label, changes, protocol in cases:
		scene = build(given, geometry, **changes)
		worn = math.degrees(criticalFrictionAngle(geometry['free'], geometry['fixed'], inset=changes.get('cornerRadius', radius), tolerance=1e-6).angle)
		try:
			_, result = reduce(given, scene, label, **{'steps': [1, 0.25], **protocol})
		except RuntimeError as error:  # a contact point that jumps keeps the blocks moving
			rows.append([label, '', '', worn, sum(functor.stats()['failures'] for functor in O.engines[2].geomDispatcher.functors), str(error)])
			continue
		rows.append([label, round(math.degrees(result.failed), 6), round(math.degrees(result.stable), 6), worn, result.failedQueries, ''])
	findings.table(
	        'settings', 'Other settings, in steps of 1°, then 0.25°. Beside them a limit analysis in which forces keep the corner radius away from the ends of joints.',
	        ['setting', 'fails at [°]', 'stands at [°]', 'limit analysis, corners worn off [°]', 'failed contact queries', 'remark'], rows
	)  # yapf: disable
	radii = [changes.get('cornerRadius', radius) for _, changes, _ in cases[:4]]
	findings.text(
	        'Why the blocks do not fail at the angle of the limit analysis: its blocks have sharp corners, can load each other at the very ends of their joints, and count as failed when they '
	        'begin to move. The rounding of the corners by r keeps the forces away from the ends: '
	        + '; '.join(f'r = {r:g} m: {row[1]:.2f}…{row[2]:.2f}° (analysis with ends worn off by r: {row[3]:.2f}°)' for r, row in sorted(zip(radii, rows[:4], strict=True)))
	        + f'. That the slope must move by {given.failed_distance:g} m to count as failed lowers the angle, as the blocks come to rest again after smaller motions; with 20 mm it is '
	        + next(f'{row[1]:.2f}…{row[2]:.2f}°.' for row in rows if row[0] == 'failure at 20 mm')
	)
	findings.row('failed contact queries, other settings', sum(row[4] for row in rows), '', theory=0, accept=(0, 0))


def main():
	parser, given = options()
	os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded, so before that
	import matplotlib
	import numpy as np
	import yade
	matplotlib.use('Agg')
	from yade.polytope.findings import Findings
	from yade.polytope.scenes import readSlope

	try:
		geometry = readSlope(given.geometry)
	except ValueError as error:
		parser.error(f'--geometry: {error}')
	findings = Findings('E', 'Slope with joints that do not daylight', given.output, {key: str(value) for key, value in vars(given).items()})
	scene = build(given, geometry)
	lightest = min(body.state.mass for body in scene.bodies())
	if given.time_step > 0.3 * math.sqrt(lightest / given.normal_stiffness):
		parser.error(f'--time-step must not exceed 0.3 sqrt(least mass / normal stiffness), {0.3 * math.sqrt(lightest / given.normal_stiffness):.2g} s here')
	layers = scene.layers()
	findings.text(
	        f'{len(geometry["free"])} blocks as polygons 1 m thick (true 2-D), base and back fixed. Joints have kₙ = {given.normal_stiffness:g} and kₛ = {given.shear_stiffness:g} '
	        + ('N/m for each contact' if given.stiffness_per_contact else 'Pa/m times their length')
	        + f', the corner radius is {given.corner_radius:g} m. Settled at {given.start:g}°; then the friction angle goes down in steps of {", ".join(f"{step:g}" for step in given.steps)}°. A state is '
	        f'stable when all blocks are slower than {given.stable_speed:g} m/s at three looks in turn, and has failed when one has moved by more than {given.failed_distance:g} m since the slope '
	        'had settled; a slope of such blocks arrests itself again and again after smaller motions.'
	)
	try:
		limit = limitAnalysis(given, geometry, findings, layers)
		reduction, result = reduce(given, scene, 'friction reduction')
	except (RuntimeError, ValueError) as error:  # does not stand at the first angle, or stands at all
		print(error, file=sys.stderr)
		return 1
	reduction.restore()

	pictures = []
	if not given.no_pictures:
		drawBlocks(given.output / 'stable.png', scene)
		pictures.append((given.output / 'stable.png', f'{math.degrees(result.stable):.2f}°: stands'))
	watch = watchFailure(given, scene, result)
	displacement, rotation, contacts = watch.displacement(), watch.rotation(), watch.contacts()
	failed = int(np.argmax(displacement.max(axis=1) > given.failed_distance)) if displacement.max() > given.failed_distance else len(displacement) - 1
	if not given.no_pictures:
		drawBlocks(given.output / 'collapsed.png', scene)
		pictures.append((given.output / 'collapsed.png', f'{math.degrees(watch.angle[-1]):.2f}°: a block has moved by {displacement[-1].max():.2f} m'))
		turn = dict(zip(scene.freeIds, rotation[-1].tolist(), strict=True))
		drawBlocks(given.output / 'rotations.png', scene, colorBy=lambda body: -turn[body.id], valueRange=(0, max(max(-t for t in turn.values()), 1e-3)), legend='backward rotation [°]')
		pictures.append((given.output / 'rotations.png', 'the same, by rotation'))
		drawFailure(given.output / 'failure.png', pictures)
		findings.figure('failure.png', 'Fig. 11 of the paper redrawn from our data: the slope before and after failure; colours are the layers, on the right the rotation of the blocks.')

	outer = np.array(layers) == 0
	critical = math.degrees(result.critical)
	findings.row(
	        'critical friction angle', critical, '°', theory=math.degrees(limit.angle), accept=acceptedAngles if given.reference else None,
	        note=f'stands at {math.degrees(result.stable):.3f}°, fails at {math.degrees(result.failed):.3f}°; theory: limit analysis of sharp rigid blocks'
	)
	turned = rotation[failed]
	lower = np.flatnonzero(outer)[:5]
	findings.row(
	        'least backward rotation of the lowest five outer blocks at failure', -turned[lower].max(), '°', accept=(1e-3, 90) if given.reference else None,
	        note='clockwise, the face being on the left; of all outer blocks from below: ' + ', '.join(f'{-turn:.3f}' for turn in turned[outer])
	)
	findings.row(
	        'their difference', float(np.ptp(turned[lower])), '°', note='0 if the five turn as one, as in the limit analysis'
	)
	innerTurn, innerMotion = (float(values.max(initial=0)) for values in (np.abs(turned[~outer]), displacement[failed][~outer]))
	findings.row('largest rotation of an inner block at failure', innerTurn, '°')
	findings.row('largest motion of an inner block at failure', innerMotion, 'm', accept=(0, mostInnerMotion) if given.reference else None)
	motion = np.array(watch.motion)[failed]
	cosine = float(np.sum(motion * limit.velocities) / max(np.linalg.norm(motion) * np.linalg.norm(limit.velocities), 1e-300))
	findings.row('likeness of motion and mechanism of the limit analysis', cosine, '-', theory=1, note='cosine of the two vectors of all velocities and spins; the analysis lets joints part by tan φ of what they slide, friction does not')
	spins = float(np.sum(motion[:, 2] * limit.velocities[:, 2]) / max(np.linalg.norm(motion[:, 2]) * np.linalg.norm(limit.velocities[:, 2]), 1e-300))
	findings.row('the same of the rotations alone', spins, '-', theory=1)
	queries = result.failedQueries + sum(functor.stats()['failures'] for functor in yade.O.engines[2].geomDispatcher.functors)
	findings.row('failed contact queries', queries, '', theory=0, accept=(0, 0))
	for k, name in enumerate(typeColors):
		findings.row(f'{name} contacts: before, least and most during failure', int(contacts[0, k]), '', note=f'{contacts[:, k].min()} … {contacts[:, k].max()}')

	plotMechanism(given.output / 'mechanism.png', geometry, limit, motion)
	findings.figure('mechanism.png', 'The mechanism: dual of the linear programme, and motion of the blocks when the slope has failed. Blue: blocks that turn.')
	plotReduction(given.output / 'reduction.png', result, limit)
	findings.figure('reduction.png', 'Motion since settling at each friction angle.')
	plotFailure(given.output / 'contacts.png', watch, layers)
	findings.figure('contacts.png', 'The failure: motion, rotation, and contacts by type (polygons: edge–edge is face–face of prisms, vertex–edge is edge–face, vertex–vertex is edge–edge).')
	findings.table(
	        'stages', 'The friction reduction, with the numbers of contacts of each type at the end of each stage. The first stage is the settling.', ['friction angle [°]', 'outcome', 'time [s]', 'largest motion since settling [mm]', 'largest speed at the end [m/s]', *typeColors],
	        [
	                [round(math.degrees(stage.angle), 6), stage.outcome, stage.steps * given.time_step, 1e3 * stage.displacement, stage.speed, *(stage.measured[1][name] for name in prismTypes)]
	                for stage in result.stages
	        ]
	)  # yapf: disable
	findings.table(
	        'contacts', 'Contacts by type while the slope fails.', ['time [s]', 'friction angle [°]', 'largest motion [m]', *typeColors],
	        [
	                [time - watch.time[0], round(math.degrees(angle), 6), most, *numbers]
	                for time, angle, most, numbers in zip(watch.time, watch.angle, displacement.max(axis=1).tolist(), contacts.tolist(), strict=True)
	        ]
	)  # yapf: disable
	findings.table(
	        'blocks', 'Each block when the slope has failed, and in the limit analysis (velocities over that of the fastest corner).',
	        ['block', 'layer', 'motion x [mm]', 'motion y [mm]', 'rotation [°]', 'analysis: x', 'analysis: y', 'analysis: spin [1/m]'],
	        [[k, layers[k], *(1e3 * motion[k, :2]), math.degrees(motion[k, 2]), *limit.velocities[k]] for k in range(len(layers))]
	)  # yapf: disable
	if not given.quick:
		settingsTable(given, geometry, findings)
	good = findings.save()
	findings.show()
	print(f'\nFiles: {given.output}/')
	return 0 if good else 1


if __name__ == '__main__':
	sys.exit(main())
