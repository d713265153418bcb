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
from yade import NewtonIntegrator, O, Polytope

from ._faces import collect, localVertices, reachOfWalls, rows, worldVertices
from .arguments import namedArguments

__all__ = ['picture', 'collect']

colorMap = ['#1d4e79', '#3380a8', '#86bcbb', '#f0e4ba', '#f2a541', '#c8451b']
"""Low to high; dark to light to warm, so that it is readable in grey and for colour-blind readers as well."""

shades = 256
"""Of the map that are told apart."""

usualFixedColor = (0.86, 0.86, 0.84)
viewAngle = 24
"""Vertical opening of the camera [degrees]; small, so that bodies of equal size appear equal."""

legendShare = 0.12
"""Share of the picture's height kept free for the legend, above the scene."""

centred = 1e-6
"""Of the distance of the camera: by so much the picture may be off its middle, less than a hundredth of a pixel."""

alongUp = 1e-6
"""Sine of the angle between view and up below which up says nothing."""

timeLimit = 300
"""Seconds after which drawing a picture is aborted."""


@namedArguments
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
        edges=True,
        fixedColor=usualFixedColor
):
	"""Draw the scene's bodies (Polytope, Box, Sphere, Facet, Wall) and write a PNG file. A wall is drawn as far as the other bodies reach.

	:param str path: the file; its folder is made if there is none
	:param bodies: the bodies to draw; default all of O.bodies
	:param colorBy: 'color' (each body's own), 'height' (of the centre, along *up*), 'speed', 'size' (edge of the cube of equal volume),
	    'displacement' (from refPos), or a function of the body that returns a number
	:param valueRange: (low, high) ends of the colour scale; default those of the moving bodies
	:param str legend: draw the colour scale, with this text
	:param str fixed: bodies that cannot move: 'solid', 'glass' (translucent), 'wire' (edges), 'hidden', or 'auto': wire where
	    they stand before the moving bodies, glass behind them, solid below (and solid in scenes of polygons). Or a function of
	    the body that returns one of these
	:param view: direction from the scene to the camera; default from the front, above and a little from the left, for scenes
	    of polygons along z
	:param up: direction that is up in the picture; default against gravity, without any z, for polygons y
	:param frame: points (n, 3) the picture must hold; default all vertices that are drawn. Give the same for a series.
	:param float zoom: above 1 to come nearer than the frame requires
	:param size: (width, height) in pixels
	:param background: RGB
	:param bool edges: draw the edges of the faces
	:param fixedColor: RGB of bodies that cannot move where colours follow a value, or 'own': each one's own
	:raises ValueError: naming the argument
	:raises RuntimeError: with the drawing program's message, if there is no picture
	"""
	if os.path.splitext(os.fspath(path))[1].lower() not in ('', '.png'):
		raise ValueError(f'path: pictures are PNG files, their names end in .png, got {os.fspath(path)!r}')
	drawn = [b for b in (O.bodies if bodies is None else bodies) if b and b.shape]
	flat = {b.shape.dimension for b in drawn if isinstance(b.shape, Polytope)} == {2}
	view, up = _axes(view, up, flat)
	low, high, colorOf = _colors(drawn, colorBy, valueRange, up, fixedColor)
	meshes = collect(drawn, colorOf, _styles(drawn, 'solid' if flat and fixed == 'auto' else fixed, view, up))
	if not meshes:
		raise ValueError('bodies: there is nothing to draw (only Polytope, Box, Sphere and Facet are, and a Wall beside them)')
	if frame is None:
		frame = np.concatenate([mesh['points'] for style, mesh in meshes.items() if style != 'wire' or len(meshes) == 1])
	camera = _camera(np.asarray(frame, float), view, up, size[0] / size[1], zoom, flat, legendShare if legend else 0)
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


def _axes(view, up, flat):
	"""Unit vectors: towards the camera, and up in the picture."""
	up = _unit(up if up is not None else _against(flat))
	view = _unit(view if view is not None else (0, 0, 1) if flat else _fromTheFront(up))
	if np.linalg.norm(np.cross(up, view)) < alongUp:
		up = np.eye(3)[(np.abs(view).argmax() + 1) % 3]  # seen from above
	return view, up


_values = {
        'speed': lambda body: body.state.vel.norm(),
        'size': lambda body: (body.state.mass / body.material.density)**(1 / 3),
        'displacement': lambda body: (body.state.pos - body.state.refPos).norm(),
}


def _colors(bodies, colorBy, valueRange, up, fixedColor):
	"""Ends of the scale, and the function from a body to its colour."""
	if colorBy == 'color':
		return 0, 1, lambda body: body.shape.color
	known = {**_values, 'height': lambda body: sum(float(u * x) for u, x in zip(up.tolist(), body.state.pos, strict=True))}
	value = colorBy if callable(colorBy) else known.get(colorBy)
	if value is None:
		raise ValueError(f"colorBy: must be 'color', a function, or one of {sorted(known)}, not {colorBy!r}")
	if isinstance(fixedColor, str) and fixedColor != 'own':
		raise ValueError(f"fixedColor: must be RGB or 'own', not {fixedColor!r}")
	values = [float(value(body)) for body in bodies if body.dynamic] or [0, 1]
	low, high = valueRange or (min(values), max(values))
	if valueRange is None and 0 < low < 0.1 * high:
		low = 0
	scale, span = _shades(), high - low or 1

	def colorOf(body):
		if body.dynamic:
			share = (float(value(body)) - low) / span
			return scale[round(min(1, max(0, share)) * (shades - 1))]  # what is not a number: the lowest
		return body.shape.color if isinstance(fixedColor, str) else fixedColor

	return low, high, colorOf


def _shades():
	"""The colour map at so many values, as tuples."""
	known = np.array([[int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)] for color in colorMap])
	at = np.linspace(0, 1, shades)
	places = np.linspace(0, 1, len(known))
	return list(zip(*(np.interp(at, places, channel).tolist() for channel in known.T), strict=True))


def _against(flat):
	"""Direction against gravity; of scenes without gravity z, of polygons y."""
	for engine in O.engines:
		if isinstance(engine, NewtonIntegrator):
			gravity = np.array(engine.gravity, float) * ((1, 1, 0) if flat else 1)
			if gravity.any():
				return -gravity
	return (0, 1, 0) if flat else (0, 0, 1)


def _fromTheFront(up):
	"""From the front, above and a little from the left, turned with *up* the shortest way from z."""
	view, z = np.array([-0.55, -1, 0.62]), np.array([0.0, 0, 1])
	axis, cosine = np.cross(z, up), up[2]
	if cosine < alongUp - 1:
		return view * (1, -1, -1)  # half a turn about x
	cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
	return view + cross @ view + cross @ cross @ view / (1 + cosine)


def _styles(bodies, fixed, view, up):
	"""The function from a body to the way it is drawn."""
	if callable(fixed):
		return lambda body: 'solid' if body.dynamic else fixed(body)
	if fixed not in ('auto', 'solid', 'glass', 'wire', 'hidden'):
		raise ValueError(f"fixed: must be 'auto', 'solid', 'glass', 'wire', 'hidden' or a function, not {fixed!r}")
	if fixed != 'auto':
		return lambda body: 'solid' if body.dynamic else fixed
	moving = rows(body.state.pos for body in bodies if body.dynamic)
	if not len(moving):
		return lambda body: 'solid'
	middle = np.median(moving, axis=0)  # one that has fallen off does not count
	room = reachOfWalls(bodies)

	def style(body):
		if body.dynamic:
			return 'solid'
		points = worldVertices(body, room)
		if not len(points):
			return 'hidden'
		nearest = np.clip(middle, points.min(axis=0), points.max(axis=0))  # of the body's box
		way = _unit(nearest - middle + 1e-12 * view)
		if way @ up < -math.sqrt(0.5):
			return 'solid'
		return 'wire' if way @ view > 0 else 'glass'

	return style


def _typicalRadius(bodies):
	"""Median of the half-extent of the moving bodies (of all, if none moves): the reach of the soft shading."""
	several = [body for body in bodies if body.dynamic] or bodies
	return float(np.median([_reach(body.shape) for body in several])) or 1.0


def _reach(shape):
	"""Distance of the farthest vertex from the body's position [m]."""
	return float(shape.circumscribedRadius) if isinstance(shape, Polytope) else np.linalg.norm(localVertices(shape), axis=1).max(initial=0)


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
		shift = distance * (inPicture.min(axis=0) + inPicture.max(axis=0)) / 2
		middle[:2] += shift
		if np.abs(shift).max() < centred * distance:
			break
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
