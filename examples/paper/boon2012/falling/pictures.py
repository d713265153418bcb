# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of simulation A as in the paper's Fig. 5."""

import numpy as np
from matplotlib.image import imread, imsave
from yade import O
from yade.polytope.pictures.still import picture

__all__ = ['HeapPictures']


class HeapPictures:
	"""Pictures of one run from one place, at the start, half-way and at the end; the walls are not drawn.

	:param FallingPolyhedra scene: after build(); it must still be the simulation's when draw() is called
	:param folder: for stepNNNNN.png, steps.png and end.png
	"""

	def __init__(self, scene, folder):
		self.scene, self.folder, self.paths = scene, folder, []

	def draw(self):
		"""The heap as it is now."""
		scene = self.scene
		floor, top = scene.width / 2 + scene.wallThickness, scene.lattice()[:, 2].max() + scene.spacing / 2
		frame = [(x, y, -scene.wallThickness) for x in (-floor, floor) for y in (-floor, floor)]
		frame += [(x, y, top) for x in (-scene.width / 2, scene.width / 2) for y in (-scene.width / 2, scene.width / 2)]
		self.paths.append(f'{self.folder}/step{O.iter:05d}.png')
		picture(self.paths[-1], bodies=self._bodies(), fixed='solid', frame=frame, size=(1000, 1000))

	def finish(self):
		"""All that were drawn, side by side, and the heap once more from nearer."""
		imsave(f'{self.folder}/steps.png', np.concatenate([imread(path) for path in self.paths], axis=1))
		picture(f'{self.folder}/end.png', bodies=self._bodies(), fixed='solid', size=(1600, 1000))

	def _bodies(self):
		return [body for body in O.bodies if body.id not in self.scene.wallIds]
