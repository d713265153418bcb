# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws pictures: a program of its own, called by still.py.

	python3 -P render.py FOLDER PICTURE.png [FOLDER PICTURE.png …]

Each FOLDER has meshes.npz and settings.json as still.py writes them. Needs VTK, and Xvfb for a virtual display.
"""

import contextlib
import json
import os
import shutil
import subprocess
import sys

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401  text of the legend
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkExtractEdges, vtkPolyDataNormals
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
	vtkActor,
	vtkLight,
	vtkPolyDataMapper,
	vtkRenderer,
	vtkRenderWindow,
	vtkTextActor,
	vtkWindowToImageFilter,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass

supersampling = 2
"""The picture is drawn this much larger and then reduced: smooth edges."""
shadingReduction = 2
"""The soft shading is drawn this much smaller and then enlarged: it has no detail, and its cost grows with the pixels. At full size it took
nine tenths of the time."""
shadingSamples = 32
"""Places around a pixel that are looked at for its shading."""

styleOpacity = {'solid': 1.0, 'smooth': 1.0, 'glass': 0.16, 'wire': 0.0}
edgeColor = (0.10, 0.12, 0.15)
edgeWidth = 1.1
"""Width of edges in pixels of the finished picture."""


scalePlace = 0.05, 0.40, 0.955, 0.979
"""Left, right, bottom and top of the colour scale, in shares of the picture."""
labelsOfScale, labelShare, titleShare = 4, 0.021, 0.024
"""Numbers below it; sizes of text over the picture's height."""


@contextlib.contextmanager
def virtualDisplay():
	"""DISPLAY set to an X server without a screen, which ends with the block."""
	if not shutil.which('Xvfb'):
		raise SystemExit('Xvfb is needed to draw without a screen: install the package xvfb.')
	readEnd, writeEnd = os.pipe()
	server = subprocess.Popen(
		['Xvfb', '-displayfd', str(writeEnd), '-screen', '0', '640x480x24', '-nolisten', 'tcp', '-noreset'],
		pass_fds=[writeEnd],
		stdout=subprocess.DEVNULL,
		stderr=subprocess.DEVNULL,
	)
	os.close(writeEnd)
	try:
		with os.fdopen(readEnd) as numbers:
			number = numbers.readline().strip()  # comes when the server is ready; empty if it could not start
		if not number:
			raise SystemExit('Xvfb did not start.')
		os.environ['DISPLAY'] = f':{number}'
		os.environ['LIBGL_ALWAYS_SOFTWARE'] = '1'
		yield
	finally:
		server.terminate()
		server.wait()


def polyData(mesh):
	points = vtkPoints()
	points.SetData(numpy_to_vtk(mesh['points'], deep=True))
	faces = vtkCellArray()
	faces.SetData(*(numpy_to_vtkIdTypeArray(mesh[name].astype(np.int64), deep=True) for name in ('offsets', 'connectivity')))
	colors = numpy_to_vtk(mesh['colors'], deep=True)
	colors.SetName('color')
	data = vtkPolyData()
	data.SetPoints(points)
	data.SetPolys(faces)
	data.GetCellData().SetScalars(colors)
	return data


def actorOf(style, mesh, edges):
	mapper = vtkPolyDataMapper()
	data = polyData(mesh)
	if style == 'smooth':
		normals = vtkPolyDataNormals()
		normals.SetInputData(data)
		normals.SplittingOff()
		mapper.SetInputConnection(normals.GetOutputPort())
	elif style == 'wire':
		outline = vtkExtractEdges()
		outline.SetInputData(data)
		mapper.SetInputConnection(outline.GetOutputPort())
		mapper.ScalarVisibilityOff()
	else:
		mapper.SetInputData(data)
	actor = vtkActor()
	actor.SetMapper(mapper)
	look = actor.GetProperty()
	look.SetLineWidth(edgeWidth * supersampling)
	if style == 'wire':
		look.SetColor(0.68, 0.69, 0.71)
		look.LightingOff()
		return actor
	if style == 'smooth':
		look.SetInterpolationToPhong()
	else:
		look.SetInterpolationToFlat()
	look.SetAmbient(0.32)
	look.SetDiffuse(0.80)
	look.SetSpecular(0.06)
	look.SetSpecularPower(12)
	look.SetOpacity(styleOpacity[style])
	if style == 'glass':
		look.BackfaceCullingOn()  # a wall's underside lies in the floor's plane
	if edges and style != 'smooth':
		look.EdgeVisibilityOn()
		look.SetEdgeColor(*edgeColor)
	return actor


def addLights(renderer, camera):
	"""A key light over the camera's left shoulder, a weak fill from its right, a little from above."""
	renderer.AutomaticLightCreationOff()
	focus, position, up = (np.array(camera[name]) for name in ('focus', 'position', 'up'))
	back = position - focus
	back /= np.linalg.norm(back)
	right = np.cross(up, back)
	for direction, intensity in ((-0.5 * right + 0.8 * up + 0.8 * back, 0.70), (0.9 * right + 0.1 * up + 0.6 * back, 0.25), (up, 0.12)):
		light = vtkLight()
		light.SetLightTypeToSceneLight()
		light.PositionalOff()
		light.SetFocalPoint(0, 0, 0)
		light.SetPosition(*direction)
		light.SetIntensity(intensity)
		renderer.AddLight(light)


def placeCamera(renderer, settings):
	camera = renderer.GetActiveCamera()
	camera.SetFocalPoint(*settings['focus'])
	camera.SetPosition(*settings['position'])
	camera.SetViewUp(*settings['up'])
	if 'parallelScale' in settings:
		camera.ParallelProjectionOn()
		camera.SetParallelScale(settings['parallelScale'])
	else:
		camera.SetViewAngle(settings['viewAngle'])
	renderer.ResetCameraClippingRange()


def addLegend(renderer, legend, width, height):
	"""Text of the colour scale, in a picture of this size; drawScale() draws the colours. Returns the actors.

	VTK's own scalar bar puts its text over the colours in some pictures, and elsewhere when it is drawn a second time.
	"""
	left, right, bottom, _ = (share * length for share, length in zip(scalePlace, (width, width, height, height), strict=True))
	if 'labels' in legend:  # each below its own field
		texts = legend['labels']
		places = left + (right - left) * (np.arange(len(texts)) + 0.5) / len(texts)
	else:
		texts = [f'{value:.3g}' for value in np.linspace(legend['low'], legend['high'], labelsOfScale)]
		places = np.linspace(left, right, labelsOfScale)
	labels = [(text, place, bottom, labelShare) for text, place in zip(texts, places, strict=True)]
	titleTop = bottom - 1.5 * labelShare * height
	actors = []
	for text, x, y, share in [*labels, (legend['text'], (left + right) / 2, titleTop, titleShare)]:
		actor = vtkTextActor()
		actor.SetInput(text)
		actor.SetPosition(x, y - 0.25 * share * height)
		look = actor.GetTextProperty()
		look.SetColor(*edgeColor)
		look.SetFontSize(round(share * height))
		look.SetJustificationToCentered()
		look.SetVerticalJustificationToTop()
		renderer.AddViewProp(actor)
		actors.append(actor)
	return actors


def drawScale(pixels, legend):
	"""Into the finished picture, an array as pixelsOf() gives it."""
	height, width, _ = pixels.shape
	left, right, bottom, top = (round(share * length) for share, length in zip(scalePlace, (width, width, height, height), strict=True))
	colors = np.array([[int(color[k : k + 2], 16) for k in (1, 3, 5)] for color in legend['colors']], np.float32)
	if 'labels' in legend:
		pixels[bottom:top, left:right] = colors[np.arange(right - left) * len(colors) // (right - left)]
		return
	at, places = np.linspace(0, 1, right - left), np.linspace(0, 1, len(colors))
	pixels[bottom:top, left:right] = np.stack([np.interp(at, places, channel) for channel in colors.T], axis=-1)


def shadingPass(radius):
	"""Ambient occlusion: gaps and undersides are darker, which shows where bodies rest on each other."""
	occlusion = vtkSSAOPass()
	occlusion.SetDelegatePass(vtkRenderStepsPass())
	occlusion.SetRadius(1.6 * radius)
	occlusion.SetBias(0.04 * radius)
	occlusion.SetKernelSize(shadingSamples)
	occlusion.BlurOn()
	return occlusion


def pixelsOf(window, width, height):
	"""The scene in this size, as (height, width, 3) array in 0…255, from the bottom row up."""
	window.SetSize(width, height)
	window.Render()
	grab = vtkWindowToImageFilter()
	grab.SetInput(window)
	grab.ReadFrontBufferOff()
	grab.ShouldRerenderOff()  # it would draw everything a second time
	grab.Update()
	values = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
	return values.reshape(height, width, -1)[:, :, :3]


def reduced(pixels):
	"""The mean of each square of *supersampling* pixels a side."""
	total = np.zeros([n // supersampling for n in pixels.shape[:2]] + [3], np.uint16)
	for row in range(supersampling):
		for column in range(supersampling):
			total += pixels[row::supersampling, column::supersampling]
	return total.astype(np.float32) / supersampling**2


def shadingOf(renderer, window, settings):
	"""Factor in 0…1 for each pixel of the picture: the small picture with the shading over the one without."""
	width, height = settings['size']
	small = -(-width // shadingReduction), -(-height // shadingReduction)
	plain = pixelsOf(window, *small).sum(axis=2, dtype=np.float32)
	renderer.SetPass(shadingPass(settings['shadeRadius']))
	shaded = pixelsOf(window, *small).sum(axis=2, dtype=np.float32)
	factor = np.clip(shaded / np.maximum(plain, 1), 0, 1).astype(np.float32)
	rows, columns = (np.clip((np.arange(n) + 0.5) / shadingReduction - 0.5, 0, m - 1) for n, m in ((height, small[1]), (width, small[0])))
	for axis, places in enumerate((rows, columns)):  # linear between pixels
		low = np.minimum(places.astype(int), factor.shape[axis] - 1)
		high = np.minimum(low + 1, factor.shape[axis] - 1)
		share = np.expand_dims(places - low, 1 - axis).astype(np.float32)
		factor = (1 - share) * factor.take(low, axis) + share * factor.take(high, axis)
	return factor[:, :, None]


def write(pixels, path):
	"""PNG of an array as pixelsOf() gives it."""
	height, width, _ = pixels.shape
	image = vtkImageData()
	image.SetDimensions(width, height, 1)
	image.GetPointData().SetScalars(numpy_to_vtk(np.round(pixels).astype(np.uint8).reshape(-1, 3), deep=True))
	writer = vtkPNGWriter()
	writer.SetFileName(path)
	writer.SetInputData(image)
	writer.Write()
	if writer.GetErrorCode():
		raise SystemExit(f'cannot write {path}')


def draw(meshes, settings, path):
	width, height = settings['size']
	renderer = vtkRenderer()
	renderer.SetBackground(*settings['background'])
	for style, mesh in meshes.items():
		renderer.AddActor(actorOf(style, mesh, settings['edges']))
	addLights(renderer, settings['camera'])
	placeCamera(renderer, settings['camera'])
	legend = settings['legend']
	texts = addLegend(renderer, legend, supersampling * width, supersampling * height) if legend else []
	window = vtkRenderWindow()
	window.OffScreenRenderingOn()
	window.SetMultiSamples(0)
	window.AddRenderer(renderer)
	pixels = reduced(pixelsOf(window, supersampling * width, supersampling * height))
	if settings['shade']:
		for text in texts:
			renderer.RemoveViewProp(text)  # which would shade the scene, in the size of another picture
		pixels *= shadingOf(renderer, window, settings)
	window.Finalize()  # before the display ends
	if legend:
		drawScale(pixels, legend)
	write(pixels, path)


def main(*names):
	"""Pairs of a folder and the picture of it."""
	with virtualDisplay():
		for folder, path in zip(names[::2], names[1::2], strict=True):
			with open(os.path.join(folder, 'settings.json')) as file:
				settings = json.load(file)
			draw(meshesOf(folder), settings, path)


def meshesOf(folder):
	meshes = {}
	with np.load(os.path.join(folder, 'meshes.npz')) as arrays:
		for key in arrays:
			style, name = key.split('.')
			meshes.setdefault(style, {})[name] = arrays[key]
	return meshes


if __name__ == '__main__':
	main(*sys.argv[1:])
