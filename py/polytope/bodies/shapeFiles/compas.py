# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks of masonry from COMPAS, as its json_dump writes them (https://compas.dev): blocks are meshes, whose interfaces are not read.

- assemblies of compas_assembly and compas_cra: a graph whose nodes have a *block*, and *is_support*; before COMPAS 0.18 a graph and the
  blocks beside it;
- models of compas_dem and compas_model: *elements* with a *geometry*, and *is_support*;
- a list of meshes.

Whatever the version, a mesh has the tables *vertex* and *face*, and an object is wrapped in *data*, in older files in *value*.
"""

import json

from ..polytopes import fromVertices
from .words import warnIfNotConvex

__all__ = ['bodies']

remedy = 'compas.json_dump(assembly, path) writes assemblies of compas_assembly, models of compas_dem and lists of meshes'


def bodies(path, place, **body):
	"""Bodies of all blocks; those that are supports are fixed, unless *fixed* is given.

	:param place: from coordinates of the file to a point [m]
	"""
	try:
		with open(path, encoding='utf-8') as file:
			content = json.load(file)
	except ValueError as error:
		raise ValueError(f"path: '{path}' is no JSON ({error}); {remedy}") from None
	blocks = list(_blocks(path, content))
	if not blocks:
		raise ValueError(f"path: '{path}' has no blocks; {remedy}")
	return [_body(path, name, mesh, place, {'fixed': bool(support), **body}) for name, mesh, support in blocks]


def _blocks(path, content):
	"""(name, mesh, whether it is a support) of each, in the order of their numbers."""
	if isinstance(content, list):
		yield from ((k, mesh, False) for k, mesh in enumerate(content))
	elif isinstance(content, dict) and 'blocks' in content and 'assembly' in content:
		nodes = content['assembly']['vertex']
		yield from ((k, content['blocks'][k], nodes[k].get('is_support')) for k in _inOrder(content['blocks']))
	else:
		model = _opened(content)
		graph = _opened(model.get('graph'))
		if 'elements' in model:
			for k, element in model['elements'].items():
				inner = _opened(element)
				if inner.get('transformation') is not None:
					raise ValueError(
						f"path: '{path}', element {k} is moved by a transformation; save a list of meshes: compas.json_dump([e.modelgeometry for e in model.elements()], path)"
					)
				yield k, inner.get('geometry'), inner.get('is_support')
		else:
			nodes = model.get('node') or graph.get('node') or {}
			yield from ((k, nodes[k].get('block'), nodes[k].get('is_support')) for k in _inOrder(nodes))


def _opened(wrapped):
	"""What is in an object that is wrapped any number of times; an empty table for what is none."""
	while isinstance(wrapped, dict) and ('dtype' in wrapped or set(wrapped) <= {'data', 'datatype', 'compas', 'guid', 'value'}):
		inner = wrapped.get('value', wrapped.get('data'))
		if not isinstance(inner, dict):
			return {}
		wrapped = inner
	return wrapped if isinstance(wrapped, dict) else {}


def _inOrder(table):
	return sorted(table, key=lambda key: (not key.isdigit(), int(key) if key.isdigit() else 0, key))


def _body(path, name, mesh, place, body):
	mesh = _opened(mesh)
	try:
		keys = {str(key): k for k, key in enumerate(_inOrder(mesh['vertex']))}
		corners = [mesh['vertex'][key] for key in keys]
		points = [place((float(one['x']), float(one['y']), float(one['z']))) for one in corners]
		faces = [[keys[str(key)] for key in face] for face in mesh['face'].values()]
	except (AttributeError, KeyError, TypeError, ValueError):
		raise ValueError(f"path: '{path}', block {name}: is no mesh with the tables vertex and face; {remedy}") from None
	try:
		made = fromVertices(points, **body)
	except ValueError as error:
		if not str(error).startswith('points'):
			raise
		raise ValueError(f"path: '{path}', block {name}: its vertices make no body ({error})") from None
	warnIfNotConvex(f"block {name} of '{path}'", made, points, faces)
	return made
