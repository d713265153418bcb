# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws one picture: a program of its own, called by pictures.py.

	python3 -P render.py FOLDER PICTURE.png

FOLDER has meshes.npz and settings.json as pictures.py writes them. Needs VTK, and Xvfb for a virtual display.
"""
import contextlib
import json
import os
import shutil
import subprocess
import sys

import numpy as np

supersampling = 2
"""The picture is drawn this much larger and then reduced: smooth edges."""

styleOpacity = {'solid': 1.0, 'smooth': 1.0, 'glass': 0.16, 'wire': 0.0}
edgeColor = (0.10, 0.12, 0.15)
edgeWidth = 1.1
"""In pixels of the finished picture."""


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
	        stderr=subprocess.DEVNULL
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
	import vtk
	from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
	points = vtk.vtkPoints()
	points.SetData(numpy_to_vtk(mesh['points'], deep=True))
	faces = vtk.vtkCellArray()
	faces.SetData(*(numpy_to_vtkIdTypeArray(mesh[name].astype(np.int64), deep=True) for name in ('offsets', 'connectivity')))
	colors = numpy_to_vtk(mesh['colors'], deep=True)
	colors.SetName('color')
	data = vtk.vtkPolyData()
	data.SetPoints(points)
	data.SetPolys(faces)
	data.GetCellData().SetScalars(colors)
	return data


def actorOf(style, mesh, edges):
	import vtk
	mapper = vtk.vtkPolyDataMapper()
	data = polyData(mesh)
	if style == 'smooth':
		normals = vtk.vtkPolyDataNormals()
		normals.SetInputData(data)
		normals.SplittingOff()
		mapper.SetInputConnection(normals.GetOutputPort())
	elif style == 'wire':
		outline = vtk.vtkExtractEdges()
		outline.SetInputData(data)
		mapper.SetInputConnection(outline.GetOutputPort())
		mapper.ScalarVisibilityOff()
	else:
		mapper.SetInputData(data)
	actor = vtk.vtkActor()
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
	import vtk
	renderer.AutomaticLightCreationOff()
	focus, position, up = (np.array(camera[name]) for name in ('focus', 'position', 'up'))
	back = position - focus
	back /= np.linalg.norm(back)
	right = np.cross(up, back)
	for direction, intensity in ((-0.5 * right + 0.8 * up + 0.8 * back, 0.70), (0.9 * right + 0.1 * up + 0.6 * back, 0.25), (up, 0.12)):
		light = vtk.vtkLight()
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


def addLegend(renderer, legend, height):
	import vtk
	table = vtk.vtkLookupTable()
	colors = [[int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)] for color in legend['colors']]
	table.SetNumberOfTableValues(256)
	for k in range(256):
		rgb = [np.interp(k / 255, np.linspace(0, 1, len(colors)), [color[c] for color in colors]) for c in range(3)]
		table.SetTableValue(k, *rgb, 1)
	table.SetTableRange(legend['low'], legend['high'])
	bar = vtk.vtkScalarBarActor()
	bar.SetLookupTable(table)
	bar.SetTitle(legend['text'])
	bar.SetNumberOfLabels(4)
	bar.SetLabelFormat('%.3g')
	bar.UnconstrainedFontSizeOn()
	for text, share in ((bar.GetTitleTextProperty(), 0.024), (bar.GetLabelTextProperty(), 0.021)):
		text.SetColor(*edgeColor)
		text.SetFontSize(int(share * height))
		text.BoldOff()
		text.ItalicOff()
		text.ShadowOff()
	bar.SetOrientationToHorizontal()
	bar.SetPosition(0.05, 0.88)
	bar.SetPosition2(0.35, 0.10)
	bar.SetBarRatio(0.22)
	bar.SetTextPositionToPrecedeScalarBar()
	bar.SetVerticalTitleSeparation(int(0.01 * height))
	renderer.AddViewProp(bar)


def shadingPass(radius):
	"""Ambient occlusion: gaps and undersides are darker, which shows where bodies rest on each other."""
	import vtk
	occlusion = vtk.vtkSSAOPass()
	occlusion.SetDelegatePass(vtk.vtkRenderStepsPass())
	occlusion.SetRadius(1.6 * radius)
	occlusion.SetBias(0.04 * radius)
	occlusion.SetKernelSize(128)
	occlusion.BlurOn()
	return occlusion


def draw(meshes, settings, path):
	import vtk
	width, height = (supersampling * n for n in settings['size'])
	renderer = vtk.vtkRenderer()
	renderer.SetBackground(*settings['background'])
	for style, mesh in meshes.items():
		renderer.AddActor(actorOf(style, mesh, settings['edges']))
	addLights(renderer, settings['camera'])
	placeCamera(renderer, settings['camera'])
	if settings['legend']:
		addLegend(renderer, settings['legend'], height)
	if settings['shade']:
		renderer.SetPass(shadingPass(settings['shadeRadius']))

	window = vtk.vtkRenderWindow()
	window.OffScreenRenderingOn()
	window.SetMultiSamples(0)
	window.SetSize(width, height)
	window.AddRenderer(renderer)
	window.Render()

	pixels = vtk.vtkWindowToImageFilter()
	pixels.SetInput(window)
	pixels.ReadFrontBufferOff()
	smooth = vtk.vtkImageSincInterpolator()
	smooth.AntialiasingOn()
	reduced = vtk.vtkImageResize()
	reduced.SetInputConnection(pixels.GetOutputPort())
	reduced.SetInterpolator(smooth)
	reduced.SetOutputDimensions(*settings['size'], 1)
	writer = vtk.vtkPNGWriter()
	writer.SetFileName(path)
	writer.SetInputConnection(reduced.GetOutputPort())
	writer.Write()
	window.Finalize()  # before the display ends
	if writer.GetErrorCode():
		raise SystemExit(f'cannot write {path}')


def main(folder, path):
	with open(os.path.join(folder, 'settings.json')) as file:
		settings = json.load(file)
	meshes = {}
	with np.load(os.path.join(folder, 'meshes.npz')) as arrays:
		for key in arrays:
			style, name = key.split('.')
			meshes.setdefault(style, {})[name] = arrays[key]
	with virtualDisplay():
		draw(meshes, settings, path)


if __name__ == '__main__':
	main(*sys.argv[1:])
