# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures written as one file that moves: GIF by Pillow, MP4 by the program ffmpeg."""

import os
import shutil
import subprocess

import numpy as np
import scipy  # loads its packages at their first use: half a second

__all__ = ['checkedName', 'encode']

colorsOfGif = 256
"""Colours of a film in GIF: as many as the format has."""
forPalette = 8
"""Frames of a film that its colours are chosen from: one palette for all, so that what is at rest keeps its colour."""


def checkedName(path):
	"""The absolute path of a file that can be written there; makes its folder.

	:raises ValueError: if it is of another kind, if the encoder is not installed, or if the folder cannot be written to
	"""
	path = os.path.abspath(os.fspath(path))
	suffix = os.path.splitext(path)[1].lower()
	if suffix not in ('.gif', '.mp4'):
		raise ValueError(f'path: films are GIF or MP4 files, their names end in .gif or .mp4, got {path!r}')
	if suffix == '.mp4' and not shutil.which('ffmpeg'):
		raise ValueError('path: MP4 needs the program ffmpeg: install the package ffmpeg, or give a name that ends in .gif')
	folder = os.path.dirname(path)
	try:
		os.makedirs(folder, exist_ok=True)
	except OSError as error:
		raise ValueError(f'path: the folder {folder} cannot be made ({error.strerror}); give another one') from None
	if os.path.isdir(path) or not os.access(path if os.path.exists(path) else folder, os.W_OK):
		raise ValueError(f'path: {path} cannot be written; give another name or folder')
	return path


def encode(path, pictures, fps):
	"""Writes a film.

	:param pictures: PNG files of the same size, 0.png, 1.png and so on in one folder
	:raises RuntimeError: if it cannot be written, with the reason
	"""
	try:
		(_gif if path.lower().endswith('.gif') else _mp4)(path, pictures, fps)
	except OSError as error:
		raise RuntimeError(f'path: {path} was not written: {error}') from error


def _gif(path, pictures, fps):
	from PIL import Image  # films alone need it

	def opened(name):
		with Image.open(name) as image:
			return image.convert('RGB')

	palette = _palette([opened(name) for name in pictures[:: -(-len(pictures) // forPalette)]])
	nearest = scipy.spatial.cKDTree(palette)

	def indexed(name):  # Pillow's own search takes neighbouring colours for one: white becomes grey
		image = opened(name)
		rgb, _, which = _colorsOf([image])
		chosen = nearest.query(rgb)[1].astype(np.uint8)[which]
		found = Image.fromarray(chosen.reshape(image.height, image.width))
		found.putpalette(palette.ravel().tolist())
		return found

	frames = map(indexed, pictures)
	hundredths = max(2, round(100 / fps))
	next(frames).save(path, save_all=True, append_images=frames, duration=10 * hundredths, loop=0)


def _colorsOf(images):
	"""RGB (n, 3) of all different colours, how many pixels have each, and the row of each pixel's."""
	pixels = np.concatenate([np.asarray(image).reshape(-1, 3) for image in images]).astype(np.uint32)
	found, which, counts = np.unique(pixels @ np.array([65536, 256, 1], np.uint32), return_inverse=True, return_counts=True)
	return np.stack([found >> 16, found >> 8 & 255, found & 255], axis=-1).astype(np.uint8), counts, which


def _palette(images):
	"""Palette of all these images, (256, 3) bytes. A colour counts by the root of the number of its pixels: a large floor would else take nearly
	all. That of most pixels, which is the background's, is kept as it is."""
	from PIL import Image

	rgb, counts, _ = _colorsOf(images)
	counted = np.repeat(rgb, np.sqrt(counts).astype(int), axis=0)
	palette = np.array(Image.fromarray(counted[None]).quantize(colorsOfGif, kmeans=2).getpalette()).reshape(-1, 3)
	commonest = rgb[counts.argmax()].astype(int)
	palette[np.abs(palette - commonest).sum(axis=1).argmin()] = commonest
	return palette.astype(np.uint8)


def _mp4(path, pictures, fps):
	numbered = os.path.join(os.path.dirname(pictures[0]), '%d.png')
	# H.264 as browsers and slides show it, which needs even numbers of pixels
	shown = ['-vf', 'pad=ceil(iw/2)*2:ceil(ih/2)*2', '-c:v', 'libx264', '-pix_fmt', 'yuv420p', '-movflags', '+faststart']
	command = ['ffmpeg', '-loglevel', 'error', '-y', '-framerate', f'{fps:g}', '-i', numbered, *shown, path]
	done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
	if done.returncode != 0:
		raise RuntimeError(f'path: {path} was not written by ffmpeg.\n{done.stderr.strip()}')
