# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of targets and measured values."""

import dataclasses
import math

import scenes
from scenes import median, solids


@dataclasses.dataclass
class Row:
	"""One target. *ratio* is what the target bounds; *ours* and *peer* are what it is made of, with units."""

	measure: str
	target: str
	ours: str
	peer: str
	ratio: float
	met: bool
	"""None: there is no target, the ratio is reported."""


def atMost(measure, bound, against, ours, peer, form='{:.3f} µs'):
	ratio = ours / peer
	return Row(measure, f'≤ {bound} × {against}', form.format(ours), form.format(peer), ratio, ratio <= bound)


def atLeast(measure, bound, against, ours, peer, form='{:.3f} µs'):
	ratio = peer / ours
	return Row(measure, f'≥ {bound} × faster than {against}', form.format(ours), form.format(peer), ratio, ratio >= bound)


def reported(measure, against, ours, peer, form='{:.3f} µs'):
	return Row(measure, f'reported, × {against}', form.format(ours), form.format(peer), ours / peer, None)


def below(measure, bound, ours, unit='µs'):
	return Row(measure, f'< {bound} {unit} here', f'{ours:.3f} {unit}', '', math.nan, ours < bound)


def kernelRows(kernels):
	"""Rows of the kernels; those of a peer that is not there are left out."""
	rows = []

	def time(method, name):
		found = kernels.get((method, name))
		return found.median if found else None

	def compare(kind, measure, bound, method, peer, name):
		ours, other = time(method, name), time(peer, name)
		if ours and other:
			wrong = kernels[peer, name].wrong
			rows.append(kind(f'{measure}, {name}', bound, peer + (f' ({wrong} wrong)' if wrong else ''), ours, other))

	for name in solids:
		compare(atMost, 'touching, cold', 1.0, 'ours cold', 'libccd MPR', name)
	for name in solids:
		compare(atMost, 'touching, cold', 0.5, 'ours cold', 'coal GJK+EPA', name)
	for name in solids:
		compare(atMost, 'touching, warm', 0.4, 'ours warm', 'libccd MPR', name)
	rows.append(below('touching, warm, cube', 0.2, time('ours warm', 'cube')))
	for name in solids:
		compare(atMost, 'separated, warm', 0.1, 'ours warm', 'coal GJK+EPA', f'{name} apart')
	rows.append(below('separated, warm, slowest solid', 0.03, max(time('ours warm', f'{name} apart') for name in solids)))
	for name in ('hull 50', 'hull 200'):
		compare(atMost, 'cold', 0.5, 'ours cold', 'coal GJK+EPA', name)
	each = {planes: time('ours cold', f'hull {planes}') / (2 * planes) for planes in (20, 200)}
	rows.append(atMost('cost per plane, 200 faces, cold', 1.0, 'that at 20', each[200], each[20], '{:.4f} µs'))
	for name in solids:
		compare(atLeast, 'LP alone, cold', 100, 'ours, LP alone cold', 'CLP, as YADE calls it', name)
	for name in solids:
		compare(atLeast, 'LP alone, cold', 5, 'ours, LP alone cold', 'CLP, one model reused', name)
	for name in (*solids, 'hull 50', 'hull 200'):
		compare(atMost, 'whole cold query', 25, 'ours cold', 'one pass', name)
	sets = list(dict.fromkeys(name for _, name in kernels))
	for start in ('cold', 'warm'):
		for name in sets:
			ours, peer = time(f'ours {start}', name), time('libccd MPR', name)
			if ours and peer and name not in solids and not name.endswith(' apart'):
				rows.append(reported(f'touching, {start}, {name}', 'libccd MPR', ours, peer))
	for start in ('cold', 'warm'):
		for name in solids:
			rows.append(reported(f'boon2012, {start}, {name}', 'the default', time(f'boon2012 {start}', name), time(f'ours {start}', name)))
	return rows


def shapeRows(found):
	cost = found['microseconds']
	cuts = [name for name in cost if name.split()[0].isdigit()]  # '100000 blocks'
	(few, fewer), (many, more) = zip(cuts, found['blocks'], strict=True)
	return [
		below('body of a known shape, cube', 15, cost['equal cubes']),
		below('body of a known shape, icosahedron', 15, cost['equal icosahedra']),
		below('body of a known shape, hull of 20 points', 15, cost['equal hulls of 20 points']),
		below('body of a new hull of 20 points', 200, cost['new hulls of 20 points']),
		below(f'jointedRock, {more} blocks, per block', 200, cost[many]),
		atMost(f'jointedRock, per block, {more} blocks', 1.2, f'that of {fewer}', cost[many], cost[few], '{:.1f} µs'),
	]


def resultRows(found):
	"""Rows of results in processor time; that of the clock is in results.json."""
	size = f"{found['bodies']} bodies, {found['contacts']} contacts"
	ours, spheres = found, found['spheres']

	def row(name, bound, key):
		return below(f'{name}, {size}', bound, ours[key]['processor'], 's')

	def beside(name, key):
		times = (one[key]['processor'] for one in (ours, spheres))
		return reported(f"{name}, {found['bodies']} bodies", "YADE's spheres", *times, '{:.2f} s')

	return [
		below(f'polytope.arrays(), {size}', 50, 1e3 * found['arrays']['processor'], 'ms'),
		row('PolytopeVTKRecorder, bodies and contacts', 1, 'snapshot'),
		row('polytope.picture', 20, 'picture'),
		row('O.save', 5, 'save'),
		row('checkpoint', 5, 'checkpoint'),
		beside('PolytopeVTKRecorder, bodies alone', 'bodySnapshot'),
		beside('O.save', 'save'),
		beside('O.load', 'load'),
	]


def memoryRows(found):
	bounds = {'body': 1.1, 'pair apart': 0.3, 'contact': 1.2}
	rows = [below(f'memory of a {name}', bound, 1e-3 * found[name], 'kB') for name, bound in bounds.items()]
	for name, spheres in found['spheres'].items():
		rows.append(reported(f'memory of a {name}', "YADE's spheres", found[name], spheres, '{:.0f} B'))
	return rows


def sceneRows(found):
	rows = []
	for name, methods in found.items():
		for method, bound in (('potentialBlock', 100), ('polyhedra', 60)):
			if methods.get(method):
				# of all pairs together: which boxes that overlap make a pair differs
				ours, peer = (1e6 * median([row['loop'] for row in methods[key]['rows']]) for key in ('ours', method))
				rows.append(atLeast(f'InteractionLoop per step, 200 falling, {name}', bound, scenes.peers[method], ours, peer, '{:.0f} µs'))
	return rows


def settledRows(found):
	ours, spheres = (1e6 * median(found[key]['perContact']) for key in ('ours', 'spheres'))
	number = found['ours']['request']['number']
	return [atMost(f'InteractionLoop per contact, settled heap of {number} cubes', 4, "YADE's spheres", ours, spheres)]


def sizeRows(settled, loaded):
	rows = []
	for number, methods in settled.items():
		bound = 3 if number <= 2000 else 1
		rows.append(atMost(f'time per body and step, settled heap of {number} cubes', bound, "YADE's spheres", *perBody(methods)))
		ours, spheres = (1e6 * median([row['step'] / row['contacts'] for row in methods[key]['rows']]) for key in ('ours', 'spheres'))
		rows.append(reported(f'time per contact and step, settled heap of {number} cubes', "YADE's spheres", ours, spheres))
	rows += [
		reported(f'time per body and step, heap of {number} cubes as loaded', "YADE's spheres", *perBody(methods))
		for number, methods in loaded.items()
	]
	return rows


def besideRows(found, revision):
	return [reported(f'whole step, {name}', revision, both['ours']['perBody'], both['other']['perBody']) for name, both in found]


def perBody(methods):
	"""Ours and the spheres' [µs]."""
	return [1e6 * median(methods[key]['perBody']) for key in ('ours', 'spheres')]


def scaleRows(found):
	small, large = found['bodies'][0], found['bodies'][-1]
	rows = []
	if large is not small:
		for name, when in (('before', 'flying bodies'), ('after', 'flying bodies, saved and loaded')):
			rows.append(
				atMost(f"time per body and step, {large['bodies']} {when}", 1.3, f"that of {small['bodies']}", large[name], small[name])
			)
	if large['bodies'] >= 1e6:
		what = 'a million bodies (made; 200 steps; saved; loaded; 100 steps)'
		rows += [below(f'{what}: time', 30, large['seconds'] / 60, 'min'), below(f'{what}: memory', 24, large['gigabytes'], 'GB')]
		rows.append(below(f"PolytopeVTKRecorder, {large['bodies']} flying bodies and their contacts", 10, large['snapshot'], 's'))
	one, two = (1e3 * found['workers'][workers] for workers in (1, 2))
	return [
		*rows,
		atLeast(f"time of a step, workers 1 → 2, {found['cubes']} cubes on several processes", 1.6, 'one worker', two, one, '{:.1f} ms'),
	]


def growthRows(found, memory):
	numbers = sorted(found)
	first = numbers[0]
	cost = {number: 1e6 * median(found[number]['perBody']) for number in numbers}
	rows = [
		atMost(f'time per body and step, {number} bodies', 1.3, f'that of {first}', cost[number], cost[first]) for number in numbers[1:]
	]
	pair = {number: 1e6 * median(found[number]['perPair']) for number in numbers}
	rows += [
		reported(f'InteractionLoop per pair, {number} bodies', f'that of {first}', pair[number], pair[first]) for number in numbers[1:]
	]
	if memory.get('ours') and memory.get('polyhedra'):
		for measure, bytesOf in (('body', scenes.memoryPerBody), ('contact', scenes.memoryPerContact)):
			ours, peer = (bytesOf(memory[key]) for key in ('ours', 'polyhedra'))
			rows.append(atMost(f'memory per {measure}, 2000 cubes', 0.333, 'Polyhedra', ours, peer, '{:.0f} B'))
	return rows


def threadRows(found):
	cubes = f"{found[1]['request']['number']} cubes"
	loop = [1e6 * median([row['loop'] / row['pairs'] for row in found[threads]['rows']]) for threads in (1, 2)]
	step = [1e6 * median(found[threads]['perBody']) for threads in (1, 2)]
	return [
		atLeast(f'InteractionLoop per pair, threads 1 → 2, {cubes}', 1.85, 'one thread', loop[1], loop[0]),
		atLeast(f'time per body and step, threads 1 → 2, {cubes}', 1.7, 'one thread', step[1], step[0]),
	]
