# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of a scene as PNG files, without a window and without a screen.

	from yade.polytope.pictures.still import picture
	picture('settled.png', colorBy='height')

YADE's process only collects the faces; another one, render.py, draws them with VTK on a virtual display of its own
(Xvfb: Debian's VTK draws through X11 alone). A fault of a graphics driver cannot end a simulation that way, and the picture
is the same on every machine. Needs the packages python3-vtk9 and xvfb.
"""

import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from yade import O, Polytope

from ..arguments import namedArguments
from .camera import cameraFor, pixels, viewAxes
from .faceColors import faceColors
from .faces import collect
from .looks import colorMap, colors, styles, typicalRadius, usualFixedColor

__all__ = ['collect', 'draw', 'drawable', 'isFlat', 'keep', 'kept', 'picture', 'settingsFor', 'shownPoints']

legendShare = 0.12
"""Share of the picture's height kept free for the legend, above the scene."""

timeLimit = 300
"""Seconds after which drawing a picture is aborted."""

nothingToDraw = 'bodies: there is nothing to draw (only Polytope, Box, Sphere and Facet are, and a Wall beside them)'


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
	fixedColor=usualFixedColor,
):
	"""Draw the scene's bodies (Polytope, Box, Sphere, Facet, Wall) and write a PNG file. A wall is drawn as far as the other bodies reach.

	:param str path: the file; its folder is made if there is none
	:param bodies: the bodies to draw; default all of O.bodies
	:param colorBy: 'color' (each body's own), 'height' (of the centre, along *up*), 'speed', 'size' (edge of the cube of equal volume),
	    'displacement' (from refPos), or a function of the body that returns a number. One that returns a whole number for each plane of a
	    polytope's shape colours its faces, such as the joint sets that made them (*JointedRock.setsOfFaces*), those of a polygon along its
	    sides; grey where it is negative
	:param valueRange: (low, high) ends of the colour scale; default those of the moving bodies
	:param str legend: draw the colour scale, or the colours of faces with their numbers, with this text
	:param str fixed: bodies that cannot move: 'solid', 'glass' (translucent), 'wire' (edges), 'hidden', or 'auto': wire where
	    they stand before the moving bodies, glass behind them, solid below (and solid in scenes of polygons). Or a function of
	    the body that returns one of these
	:param view: direction from the scene to the camera; default from the front, above and a little from the left, for scenes
	    of polygons along z
	:param up: direction that is up in the picture; default against gravity, without any z, for polygons y
	:param frame: points (n, 3) the picture must hold; default all vertices that are drawn. Give it where a container is far
	    larger than what it holds, and the same for a series.
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
	size = pixels(size)
	drawn = drawable(O.bodies if bodies is None else bodies)
	flat = isFlat(drawn)
	view, up = viewAxes(view, up, flat)
	ofFaces = faceColors(drawn, colorBy, valueRange)
	low, high, colorOf = (0, 1, ofFaces.of) if ofFaces else colors(drawn, colorBy, valueRange, up, fixedColor)
	meshes = collect(drawn, colorOf, styles(drawn, fixed, view, up, flat))
	if not meshes:
		raise ValueError(nothingToDraw)
	camera = cameraFor(shownPoints(meshes, frame), view, up, size[0] / size[1], zoom, flat, legendShare if legend else 0)
	scale = legend and (ofFaces.legend(legend) if ofFaces else dict(text=legend, low=low, high=high, colors=colorMap))
	path = os.path.abspath(path)
	os.makedirs(os.path.dirname(path), exist_ok=True)
	with tempfile.TemporaryDirectory(prefix='polytope-picture-') as folder:
		keep(folder, meshes)
		draw([(folder, path)], settingsFor(camera, size, background, edges, flat, typicalRadius(drawn), scale))


def drawable(bodies):
	return [body for body in bodies if body and body.shape]


def isFlat(bodies):
	"""Whether it is a scene of polygons."""
	return {body.shape.dimension for body in bodies if isinstance(body.shape, Polytope)} == {2}


def shownPoints(meshes, frame=None):
	"""What the camera must show: the frame that was asked for, or all vertices that are drawn."""
	if frame is None:
		frame = np.concatenate([mesh['points'] for mesh in meshes.values()])
	return np.asarray(frame, float)


def settingsFor(camera, size, background, edges, flat, shadeRadius, legend):
	"""What render.py has to know beside the faces."""
	return {
		'size': list(size),
		'background': list(background),
		'camera': camera,
		'edges': edges,
		'shade': not flat,
		'shadeRadius': shadeRadius,
		'legend': legend,
	}


def keep(folder, meshes):
	"""Faces as a file for render.py."""
	arrays = {f'{style}.{name}': array for style, mesh in meshes.items() for name, array in mesh.items()}
	np.savez(os.path.join(folder, 'meshes.npz'), **arrays)


def kept(folder):
	"""The faces that such a file holds."""
	meshes = {}
	with np.load(os.path.join(folder, 'meshes.npz')) as arrays:
		for key in arrays:
			style, name = key.split('.')
			meshes.setdefault(style, {})[name] = arrays[key]
	return meshes


def draw(pictures, settings):
	"""Has render.py draw several pictures of the same settings.

	:param pictures: pairs (folder with the faces, path of the PNG file)
	:raises RuntimeError: with the drawing program's message, if it fails
	"""
	for folder, _ in pictures:
		with open(os.path.join(folder, 'settings.json'), 'w') as file:
			json.dump(settings, file)
	program = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'render.py')
	# -P: modules beside render.py must not hide others of the same name
	command = [sys.executable or 'python3', '-P', program, *(name for pair in pictures for name in pair)]
	done = subprocess.run(command, capture_output=True, text=True, timeout=timeLimit * len(pictures))
	if done.returncode != 0:
		raise RuntimeError(f'{pictures[0][1]}: no picture was drawn.\n{(done.stderr or done.stdout).strip()}')
