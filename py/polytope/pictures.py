# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of a scene as PNG files, without a window and without a screen.

	from yade.polytope.pictures import picture
	picture('settled.png', colorBy='height')

YADE's process only collects the faces; another one, render.py, draws them with VTK on a virtual display of its own
(Xvfb: Debian's VTK draws through X11 alone). A fault of a graphics driver cannot end a simulation that way, and the picture
is the same on every machine. Needs the packages python3-vtk9 and xvfb.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy as np
from yade import Box, Facet, O, Polytope, Sphere

__all__ = ['picture', 'collect']

colorMap = ['#1d4e79', '#3380a8', '#86bcbb', '#f0e4ba', '#f2a541', '#c8451b']
"""Low to high; dark to light to warm, so that it is readable in grey and for colour-blind readers as well."""

fixedColor = (0.86, 0.86, 0.84)
viewAngle = 24
"""Vertical opening of the camera [degrees]; small, so that bodies of equal size appear equal."""

legendShare = 0.12
"""Share of the picture's height kept free for the legend, above the scene."""

timeLimit = 300
"""Seconds after which drawing a picture is aborted."""


def picture(
        path,
        bodies=None,
        colorBy='color',
        valueRange=None,
        legend=None,
        fixed='auto',
        view=None,
        up=None,
        frame=None,
        zoom=1.0,
        size=(1600, 1100),
        background=(1, 1, 1),
        edges=True
):
	"""Draw the scene's bodies (Polytope, Box, Sphere, Facet) and write a PNG file.

	:param str path: the file; its folder is made if there is none
	:param bodies: the bodies to draw; default all of O.bodies
	:param colorBy: 'color' (each body's own), 'height' (centre's z), 'speed', 'size' (edge of the cube of equal volume),
	    'displacement' (from refPos), or a function of the body that returns a number
	:param valueRange: (low, high) ends of the colour scale; default those of the moving bodies
	:param str legend: draw the colour scale, with this text
	:param str fixed: bodies that cannot move: 'solid', 'glass' (translucent), 'wire' (edges), 'hidden', or 'auto': wire where
	    they stand before the moving bodies, glass behind them, solid below (and solid in scenes of polygons). Or a function of
	    the body that returns one of these
	:param view: direction from the scene to the camera; default from the front, above and a little from the left, for scenes
	    of polygons along z
	:param up: direction that is up in the picture; default z, for polygons y
	:param frame: points (n, 3) the picture must hold; default all vertices that are drawn. Give the same for a series.
	:param float zoom: above 1 to come nearer than the frame requires
	:param size: (width, height) in pixels
	:param background: RGB
	:param bool edges: draw the edges of the faces
	:raises RuntimeError: with the drawing program's message, if there is no picture
	"""
	drawn = [b for b in (O.bodies if bodies is None else bodies) if b and b.shape]
	flat = _areFlat([b.shape for b in drawn if isinstance(b.shape, Polytope)])
	view = _unit(view if view is not None else (0, 0, 1) if flat else (-0.55, -1, 0.62))
	up = _unit(up if up is not None else (0, 1, 0) if flat else (0, 0, 1))

	low, high, colorOf = _colors(drawn, colorBy, valueRange)
	if flat and fixed == 'auto':
		fixed = 'solid'
	meshes = collect(drawn, colorOf, _styles(drawn, fixed, view, up))
	if not meshes:
		raise ValueError('bodies: there is nothing to draw (only Polytope, Box, Sphere and Facet are)')
	frame = np.asarray(_allPoints(meshes) if frame is None else frame, float)
	camera = _camera(frame, view, up, size[0] / size[1], zoom, flat, legendShare if legend else 0)
	_draw(
	        path, meshes, {
	                'size': list(size),
	                'background': list(background),
	                'camera': camera,
	                'edges': edges,
	                'shade': not flat,
	                'shadeRadius': _typicalRadius(drawn),
	                'legend': legend and dict(text=legend, low=low, high=high, colors=colorMap),
	        }
	)


def _areFlat(shapes):
	return bool(shapes) and all(shape.dimension == 2 for shape in shapes)


def _allPoints(meshes):
	"""What the picture holds by default: all but wires, unless there is nothing else."""
	return np.concatenate([mesh['points'] for style, mesh in meshes.items() if style != 'wire' or len(meshes) == 1])


def collect(bodies, colorOf=lambda body: body.shape.color, styleOf=lambda body: 'solid'):
	"""The bodies' faces in world coordinates, as arrays.

	:param colorOf: function of a body: RGB in 0…1
	:param styleOf: function of a body: any word; bodies of the same word come together, 'hidden' ones not at all
	:returns: dictionary style → {points (n, 3), offsets (faces + 1), connectivity, colors (faces, 3) bytes, ids (faces)};
	    spheres are of the style 'smooth'
	"""
	parts = {}
	for body in bodies:
		style = styleOf(body)
		if style == 'hidden':
			continue
		vertices, faces = _localFaces(body.shape)
		if len(faces) == 0:
			continue
		if isinstance(body.shape, Sphere):
			style = 'smooth'
		turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
		position = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
		color = np.round(255 * np.clip(np.array(colorOf(body), float), 0, 1)).astype(np.uint8)
		parts.setdefault(style, []).append((vertices @ turn.T + np.array(position, float), faces, color, body.id))
	return {style: _joined(several) for style, several in parts.items()}


def _joined(parts):
	first = np.cumsum([0] + [len(points) for points, *_ in parts[:-1]])
	faces = [[shift + v for v in face] for (_, bodyFaces, *_), shift in zip(parts, first, strict=True) for face in bodyFaces]
	counts = [len(bodyFaces) for _, bodyFaces, *_ in parts]
	return {
	        'points': np.concatenate([points for points, *_ in parts]),
	        'offsets': np.cumsum([0] + [len(face) for face in faces]),
	        'connectivity': np.concatenate(faces),
	        'colors': np.repeat([color for _, _, color, _ in parts], counts, axis=0),
	        'ids': np.repeat([number for *_, number in parts], counts),
	}


def _localFaces(shape):
	if isinstance(shape, Polytope):
		return np.array(shape.vertices, float).reshape(-1, 3), shape.faces
	if isinstance(shape, Box):
		signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
		faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
		return signs * np.array(shape.extents, float), faces
	if isinstance(shape, Facet):
		return np.array(shape.vertices, float), [(0, 1, 2)]
	if isinstance(shape, Sphere):
		return _sphereFaces(shape.radius)
	return np.empty((0, 3)), []


def _sphereFaces(radius, rings=24):
	"""Quadrilaterals between circles of latitude; triangles at the poles would make no visible difference."""
	around = 2 * rings
	latitude, longitude = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, around, endpoint=False), indexing='ij')
	points = radius * np.stack([np.sin(latitude) * np.cos(longitude), np.sin(latitude) * np.sin(longitude), np.cos(latitude)], axis=-1)
	faces = []
	for k in range(rings):
		for i in range(around):
			here, next = k * around + i, k * around + (i + 1) % around
			faces.append((here, here + around, next + around, next))
	return points.reshape(-1, 3), faces


_values = {
        'height': lambda body: body.state.pos[2],
        'speed': lambda body: body.state.vel.norm(),
        'size': lambda body: (body.state.mass / body.material.density)**(1 / 3),
        'displacement': lambda body: (body.state.pos - body.state.refPos).norm(),
}


def _colors(bodies, colorBy, valueRange):
	"""Ends of the scale, and the function from a body to its colour."""
	if colorBy == 'color':
		return 0, 1, lambda body: body.shape.color
	value = colorBy if callable(colorBy) else _values.get(colorBy)
	if value is None:
		raise ValueError(f"colorBy: must be 'color', a function, or one of {sorted(_values)}, not {colorBy!r}")
	values = [value(body) for body in bodies if body.dynamic] or [0, 1]
	low, high = valueRange or (min(values), max(values))
	if valueRange is None and 0 < low < 0.1 * high:
		low = 0
	from matplotlib.colors import LinearSegmentedColormap
	scale = LinearSegmentedColormap.from_list('polytope', colorMap)
	span = high - low or 1
	return low, high, lambda body: scale((value(body) - low) / span)[:3] if body.dynamic else fixedColor


def _styles(bodies, fixed, view, up):
	"""The function from a body to the way it is drawn."""
	if callable(fixed):
		return lambda body: 'solid' if body.dynamic else fixed(body)
	if fixed not in ('auto', 'solid', 'glass', 'wire', 'hidden'):
		raise ValueError(f"fixed: must be 'auto', 'solid', 'glass', 'wire', 'hidden' or a function, not {fixed!r}")
	if fixed != 'auto':
		return lambda body: 'solid' if body.dynamic else fixed
	moving = [body.state.pos for body in bodies if body.dynamic]
	if not moving:
		return lambda body: 'solid'
	middle = np.median(np.array(moving, float), axis=0)  # one that has fallen off does not count

	def style(body):
		if body.dynamic:
			return 'solid'
		points, faces = _localFaces(body.shape)
		if len(faces) == 0:
			return 'hidden'
		turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
		points = points @ turn.T + np.array(body.state.pos, float)
		nearest = np.clip(middle, points.min(axis=0), points.max(axis=0))  # of the body's box
		way = _unit(nearest - middle + 1e-12 * view)
		if way @ up < -math.sqrt(0.5):
			return 'solid'
		return 'wire' if way @ view > 0 else 'glass'

	return style


def _typicalRadius(bodies):
	"""Median of the half-extent of the moving bodies (of all, if none moves): the reach of the soft shading."""
	several = [body for body in bodies if body.dynamic] or bodies
	return float(np.median([np.linalg.norm(_localFaces(body.shape)[0], axis=1).max(initial=0) for body in several])) or 1.0


def _camera(points, view, up, aspect, zoom, flat, free):
	"""The camera in the direction *view* from the scene that shows all points, with a share of the height left *free* above them."""
	right = _unit(np.cross(up, view))
	axes = np.array([right, np.cross(view, right), view])  # right, up, towards the camera
	local = points @ axes.T
	middle = (local.min(axis=0) + local.max(axis=0)) / 2
	margin = 1.04 / zoom
	if flat:
		extent = np.ptp(local, axis=0)
		height = margin * max(extent[1] / (1 - free), extent[0] / aspect, 1e-12)
		middle[1] += free * height / 2
		return _cameraAt(middle, extent[2] + height, axes, {'parallelScale': height / 2})
	slope = math.tan(math.radians(viewAngle / 2))
	reach = slope * np.array([aspect, 1 - free])
	for _ in range(20):  # perspective: nearer points reach farther out, so the middle moves with the distance
		seen = local - middle
		distance = max((margin * np.abs(seen[:, :2]) / reach + seen[:, 2:]).max(), 1e-12)
		inPicture = seen[:, :2] / (distance - seen[:, 2:])
		middle[:2] += distance * (inPicture.min(axis=0) + inPicture.max(axis=0)) / 2
	middle[1] += free * slope * distance
	return _cameraAt(middle, distance, axes, {'viewAngle': viewAngle})


def _cameraAt(middle, distance, axes, lens):
	focus = middle @ axes
	return {'focus': list(focus), 'position': list(focus + distance * axes[2]), 'up': list(axes[1]), **lens}


def _unit(vector):
	vector = np.array(vector, float)
	return vector / np.linalg.norm(vector)


def _draw(path, meshes, settings):
	path = os.path.abspath(path)
	os.makedirs(os.path.dirname(path), exist_ok=True)
	with tempfile.TemporaryDirectory(prefix='polytope-picture-') as folder:
		arrays = {f'{style}.{name}': array for style, mesh in meshes.items() for name, array in mesh.items()}
		np.savez(os.path.join(folder, 'meshes.npz'), **arrays)
		with open(os.path.join(folder, 'settings.json'), 'w') as file:
			json.dump(settings, file)
		program = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'render.py')
		# -P: modules beside render.py must not hide others of the same name
		done = subprocess.run([sys.executable or 'python3', '-P', program, folder, path], capture_output=True, text=True, timeout=timeLimit)
	if done.returncode != 0:
		raise RuntimeError(f'{path}: no picture was drawn.\n{(done.stderr or done.stdout).strip()}')
