# SPDX-License-Identifier: GPL-2.0-or-later
"""Directions and forces of a packing as diagrams: roses of contact normals and of long axes, histogram of contact forces."""

import numbers
import os

import numpy as np

from ..scene.movers import moverOf
from .counted import bearing, massive
from .fabric import longAxes

__all__ = ['contactRose', 'forceHistogram', 'particleRose']

planes = {'xy': (0, 1), 'xz': (0, 2), 'yz': (1, 2)}


def contactRose(path=None, plane='xz', bins=36, weight='number', ids=None):
	"""Rose diagram of the directions of contacts that bear a force, seen in a plane: ``polytope.contactRose('rose.png')``.

	Each contact counts with its normal and the opposite one, with the length of its projection onto the plane: one normal to the plane has
	no direction there.

	:param path: PNG, SVG or PDF file that is drawn; None: none
	:param str plane: 'xy', 'xz' or 'yz'; angles count from the first axis to the second
	:param int bins: sectors of the full circle, even
	:param str weight: 'number', or 'force': contacts count with their normal force
	:param ids: contacts of these bodies count, one between two of them once; None: all free polytopes and spheres, and clumps of them
	:returns: (edges of the sectors [rad], bins + 1 of them, part of each), parts add up to 1
	:raises ValueError: naming the argument, or *ids* if there is no such contact
	"""
	if weight not in ('number', 'force'):
		raise ValueError(f"weight: must be 'number' or 'force', got {weight!r}")
	contacts = _of(ids)
	normals = np.array([np.array(contact.geom.normal, float) for contact in contacts])
	return _rose(path, normals, _forces(contacts) if weight == 'force' else np.ones(len(normals)), plane, bins, 'contact normals')


def particleRose(path=None, plane='xz', bins=36, ids=None):
	"""Rose diagram of the bodies' long axes (of the least moment of inertia), as contactRose() of contacts.

	:param path, plane, bins: as of contactRose
	:param ids: of polytopes; None: all free ones that are in no clump
	:returns: (edges of the sectors [rad], part of each)
	:raises ValueError: naming the argument
	"""
	axes = longAxes(ids)
	return _rose(path, axes, np.ones(len(axes)), plane, bins, 'long axes')


def forceHistogram(path=None, bins=40, ids=None):
	"""Histogram of the contacts' normal forces over their mean: ``polytope.forceHistogram('forces.png')``; strong ones fall off
	exponentially in granular matter.

	:param path: PNG, SVG or PDF file that is drawn, with a logarithmic ordinate; None: none
	:param int bins: of equal width from 0 to the largest force
	:param ids: as of contactRose
	:returns: (edges of the bins, in mean forces, probability density), whose integral is 1
	:raises ValueError: naming the argument
	"""
	forces = _forces(_of(ids))
	density, edges = np.histogram(forces / forces.mean(), _bins(bins, 1), (0, float((forces / forces.mean()).max())), density=True)
	if path is not None:
		figure, diagram = _figure()
		diagram.stairs(density, edges, fill=True)
		diagram.set_yscale('log')
		diagram.set_xlabel('normal force over its mean [-]')
		diagram.set_ylabel('probability density [-]')
		_save(figure, path)
	return edges, density


def _of(ids):
	chosen = set(massive(ids))
	contacts = [contact for contact in bearing() if {moverOf(contact.id1), moverOf(contact.id2)} & chosen]
	if not contacts:
		raise ValueError('ids: no contact of these bodies bears a force')
	return contacts


def _forces(contacts):
	return np.array([float(contact.phys.normalForce.norm()) for contact in contacts])


def _bins(bins, step):
	if isinstance(bins, bool) or not isinstance(bins, numbers.Integral) or bins < step or bins % step:
		raise ValueError(f'bins: must be a whole number above 0{", even" if step == 2 else ""}, got {bins!r}')
	return int(bins)


def _rose(path, directions, weights, plane, bins, what):
	if plane not in planes:
		raise ValueError(f"plane: must be 'xy', 'xz' or 'yz', got {plane!r}")
	seen = directions[:, planes[plane]]
	angles = np.arctan2(seen[:, 1], seen[:, 0]) % np.pi  # a direction and its opposite are one
	weights = weights * np.linalg.norm(seen, axis=1)
	if not weights.sum() > 0:
		raise ValueError(f'plane: all {what} are normal to it')
	half = _bins(bins, 2) // 2
	# sectors begin half of their width below the first axis, so that the axes are in the middle of sectors
	width = np.pi / half
	parts = np.bincount(((angles + width / 2) // width).astype(int) % half, weights, half) / weights.sum() / 2
	edges, parts = (np.arange(2 * half + 1) - 0.5) * width, np.concatenate([parts, parts])
	if path is not None:
		figure, diagram = _figure(projection='polar')
		diagram.bar(edges[:-1] + width / 2, parts, width, edgecolor='white')
		diagram.set_title(f'{what} in {plane}')
		_save(figure, path)
	return edges, parts


def _figure(**subplot):
	from matplotlib.figure import Figure

	figure = Figure(figsize=(6.4, 4.8), layout='constrained')
	return figure, figure.add_subplot(**subplot)


def _save(figure, path):
	try:
		figure.savefig(os.fspath(path), dpi=120)
	except (TypeError, ValueError) as error:
		raise ValueError(f'path: must name a PNG, SVG or PDF file, got {path!r}') from error
