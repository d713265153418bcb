# SPDX-License-Identifier: GPL-2.0-or-later
"""All bodies and contacts of the scene as NumPy arrays at once: `polytope.arrays()`."""

import threading
from typing import NamedTuple

import numpy as np
from yade import O, _polytope

from ..scene.columns import arraysOf

__all__ = ['Arrays', 'BodyArrays', 'ContactArrays', 'arrays']


class BodyArrays(NamedTuple):
	"""A row for each body there is, in the order of their ids: polytopes, spheres, walls, clumps and their members, and any other.

	An erased body has no row, so row k is not always body k: *ids* says which it is.
	"""

	ids: np.ndarray
	"""(n,)"""
	shapes: np.ndarray
	"""(n,) class of the shape, an index into *shapeNames*; -1: a body without a shape."""
	clumpIds: np.ndarray
	"""(n,) id of the clump that a member belongs to; a clump's own id in its own row; -1 for all others."""
	masks: np.ndarray
	"""(n,) Body.mask."""
	masses: np.ndarray
	"""(n,) [kg]; for a clump that of the whole, for its members what YADE has (zero or their own)."""
	positions: np.ndarray
	"""(n, 3) of the centroid [m]; in a periodic scene as it is, not wrapped into the cell."""
	orientations: np.ndarray
	"""(n, 4) quaternions (x, y, z, w), body axes to world: scipy.spatial.transform.Rotation.from_quat takes them."""
	velocities: np.ndarray
	"""(n, 3) [m/s]"""
	angularVelocities: np.ndarray
	"""(n, 3) world axes [rad/s]"""
	forces: np.ndarray
	"""(n, 3) of the last step, without gravity, as O.forces.f(id, sync=True) [N]. Contact forces are on the members of a clump; a clump's
	own row has their sum after a step. Zero in a scene that was just loaded."""
	torques: np.ndarray
	"""(n, 3) likewise, about the body's centre [N·m]"""
	shapeNames: tuple
	"""Names of the shapes' classes: 'Polytope', 'Sphere', 'Clump', …"""


class ContactArrays(NamedTuple):
	"""A row for each interaction with geometry and physics (Interaction.isReal), in YADE's order, which changes from run to run.

	Contacts of other geometries than PolytopeGeom (between spheres: ScGeom) have NaN as area and infeasibility, and status -1. What a
	geometry or physics has not is NaN: points and normals but for those YADE derives from GenericSpheresContact, depths but for ScGeom.
	"""

	ids: np.ndarray
	"""(n, 2) of body 1 and body 2"""
	images: np.ndarray
	"""(n, 3) Interaction.cellDist: in a periodic scene the image of body 2 that is touched, in cells; zero otherwise."""
	statuses: np.ndarray
	"""(n,) how the last query ended, an index into *statusNames*; -1: no PolytopeGeom. A rock joint that is open but remembered is here."""
	points: np.ndarray
	"""(n, 3) world coordinates [m]"""
	normals: np.ndarray
	"""(n, 3) unit vectors from body 1 to body 2"""
	forces: np.ndarray
	"""(n, 3) on body 2, normal and shear force together [N]; body 1 gets the opposite. NaN for physics without a normal force."""
	normalForces: np.ndarray
	"""(n, 3) on body 2 [N]"""
	shearForces: np.ndarray
	"""(n, 3) on body 2 [N]; zero for physics without one"""
	areas: np.ndarray
	"""(n,) PolytopeGeom.contactArea [m²]: zero where neither a law nor *computeArea* asks for it"""
	depths: np.ndarray
	"""(n,) penetrationDepth, positive in overlap [m]. NaN in a scene that was just loaded: YADE does not save it."""
	infeasibilities: np.ndarray
	"""(n,) PolytopeGeom.infeasibility [m]"""
	statusNames: tuple
	"""Names of the statuses, as PolytopeGeom.status has them."""


class Arrays(NamedTuple):
	"""What polytope.arrays() returns."""

	bodies: BodyArrays
	contacts: ContactArrays


def arrays():
	"""Fields of all bodies and contacts of the scene as they are now, as NumPy arrays: ``polytope.arrays().bodies.positions``.

	Copies: they neither follow the scene nor change it. They are filled in C++, without a loop in Python. Numbers are float64 (in YADE's
	wider precisions rounded to it) and int32. ``numpy.savez(file, **arrays().bodies._asdict())`` writes them.

	:returns: Arrays with *bodies* (BodyArrays) and *contacts* (ContactArrays), whose help texts say what each field is
	:raises RuntimeError: while a run in the background changes the scene; a PyRunner may call it at any time
	"""
	if O.running and threading.current_thread() is threading.main_thread():
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first, or call this from a PyRunner')
	bodies, shapeNames = _polytope.bodyColumns()
	contacts, statusNames = _polytope.contactColumns()
	return Arrays(
		BodyArrays(**arraysOf(bodies), shapeNames=shapeNames),
		ContactArrays(**arraysOf(contacts), statusNames=statusNames),
	)
