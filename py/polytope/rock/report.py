# SPDX-License-Identifier: GPL-2.0-or-later
"""What is measured of a jointed rock: block sizes and shapes, joints per volume and per length, a stereonet."""

import dataclasses
import math
import os

import numpy as np

from ..arguments import namedArguments, vector
from .faces import shapeOf
from .given import lengthWithin, refuseOthers
from .joint import anglesOf

__all__ = ['RockReport', 'rockReport', 'scanLine', 'stereonet']

outside = 1e-3
"""Part of a line that may lie outside the rock: ends on its faces, to rounding, and along joints."""

formats = ('.png', '.svg', '.pdf')
"""Endings of the names of pictures."""
colours = ('tab:blue', 'tab:orange', 'tab:green', 'tab:red', 'tab:purple', 'tab:brown', 'tab:pink', 'tab:olive')


@dataclasses.dataclass
class RockReport:
	"""What *rockReport* measures; printed it is a table."""

	volumes: np.ndarray
	"""Volumes of the bodies [m³]."""
	flatness: np.ndarray
	"""Shortest over longest extent of each body, along the principal axes of its corners."""
	parts: np.ndarray
	"""Number of blocks of each body."""
	p32: np.ndarray
	"""Area of joints per volume [1/m] of each joint set, joints that end in the rock with their own area."""
	uncut: int
	"""Cuts that were not made because of *smallest*."""

	def __str__(self):
		smallest, flattest = int(self.volumes.argmin()), int(self.flatness.argmin())
		low, middle, high = np.quantile(self.volumes, (0.1, 0.5, 0.9))
		several = self.parts > 1
		lines = [
			f'bodies            {len(self.volumes)}, {self.volumes.sum():.6g} m³',
			f'of several blocks {several.sum()}, {self.volumes[several].sum():.6g} m³, the largest of {self.parts.max()} blocks',
			f'volume            {low:.3g}, {middle:.3g}, {high:.3g} m³ (10, 50, 90 %), largest {self.volumes.max():.3g} m³',
			f'smallest          body {smallest}, {self.volumes[smallest]:.3g} m³',
			f'flattest          body {flattest}, 1 : {1 / self.flatness[flattest]:.3g}, {self.volumes[flattest]:.3g} m³',
			f'joints            {self.p32.sum():.4g} m²/m³: ' + ', '.join(f'set {k} {one:.4g}' for k, one in enumerate(self.p32)),
			f'cuts not made     {self.uncut}',
		]
		return '\n'.join(lines)


@namedArguments
def rockReport(rock):
	"""Sizes and shapes of the bodies of a jointed rock, and its joints per volume: ``print(polytope.rockReport(rock))``.

	:param JointedRock rock: what jointedRock made
	:returns: *RockReport*
	:raises ValueError: naming *rock* if it is something else
	"""
	refuseOthers(rock)
	volumes = np.array([rock.volumes[parts].sum() for parts in rock.bodies])
	flatness = np.array([_flatness([shapeOf(*rock.blocks[k])[0] for k in parts]) for parts in rock.bodies])
	areas = np.bincount(rock.sets, rock.areas, minlength=1) if len(rock.sets) else np.zeros(1)
	return RockReport(volumes, flatness, np.array([len(parts) for parts in rock.bodies]), areas / rock.volumes.sum(), rock.uncut)


def _flatness(corners):
	points = np.concatenate(corners)
	points = points - points.mean(axis=0)
	axes = np.linalg.eigh(points.T @ points)[1]
	extents = np.ptp(points @ axes, axis=0)
	return float(extents.min() / extents.max())


@namedArguments
def scanLine(rock, start, end):
	"""Joints that a line meets, such as a borehole: their number over its length is P10.

	:param JointedRock rock: what jointedRock made
	:param start, end: of the line, inside the region [m]
	:returns: (distances from the start [m], rows of *rock.joints*), in the order along the line
	:raises ValueError: naming *rock* if it is something else, *end* if it is the start or the line leaves the rock
	"""
	refuseOthers(rock)
	first, last = (np.array(vector(point, name), float) for point, name in ((start, 'start'), (end, 'end')))
	along = last - first
	length = float(np.linalg.norm(along))
	if not length:
		raise ValueError('end: must not be the start')
	within = lengthWithin(rock, first, along)
	if within < length * (1 - outside):
		raise ValueError(
			f'end: {within:.4g} of {length:.4g} m of the line lie in the rock; joints per length are told of a line inside alone, shorten it'
		)
	slopes, heights = rock.joints[:, :3] @ along, rock.joints[:, 3] - rock.joints[:, :3] @ first
	with np.errstate(divide='ignore', invalid='ignore'):
		parts = heights / slopes
	met = [k for k in np.flatnonzero((parts >= 0) & (parts <= 1)) if _holds(rock.network[k], first + parts[k] * along)]
	met.sort(key=lambda k: parts[k])
	return length * parts[met], np.array(met, int)


def _holds(cut, point):
	"""Whether a point of its plane is on the joint."""
	return (not cut.radius or np.linalg.norm(point - cut.centre) < cut.radius) and bool((cut.edges[:, :3] @ point <= cut.edges[:, 3]).all())


@namedArguments
def stereonet(rock, path):
	"""Draws the poles of the joints, by set, on the lower hemisphere in equal area (Schmidt's net).

	:param JointedRock rock: what jointedRock made
	:param path: PNG, SVG or PDF file
	:returns: (dips, dip directions) of the joints [rad]
	:raises ValueError: naming *rock* or *path* if it is none
	:raises FileNotFoundError: if the folder is not there
	"""
	refuseOthers(rock)
	if not isinstance(path, (str, os.PathLike)):
		raise ValueError(f'path: must be the name of a PNG, SVG or PDF file, got {path!r}')
	folder, ending = os.path.split(os.fspath(path))[0], os.path.splitext(os.fspath(path))[1].lower()
	if ending not in formats:
		raise ValueError(f"path: its name must end in {', '.join(formats)}, got '{os.fspath(path)}'")
	if not os.path.isdir(folder or '.'):
		raise FileNotFoundError(f"path: there is no folder '{folder}'; make it first")
	from matplotlib.figure import Figure

	angles = np.array([anglesOf(plane[:3]) for plane in rock.joints]).reshape(-1, 2)
	figure = Figure(figsize=(5, 5), layout='constrained')
	net = figure.add_subplot(projection='polar', theta_direction=-1, theta_offset=math.pi / 2)
	for one in np.unique(rock.sets):
		dips, directions = angles[rock.sets == one].T
		# the pole, normal downward, plunges by 90° less the dip, against the dip direction
		label = f'set {one}: {len(dips)}'
		net.plot(directions + math.pi, math.sqrt(2) * np.sin(dips / 2), '.', color=colours[one % len(colours)], label=label)
	net.set_rlim(0, 1)
	net.set_yticks([math.sqrt(2) * math.sin(math.radians(dip) / 2) for dip in (30, 60)], ['30°', '60°'])
	net.set_xticks([0, math.pi / 2, math.pi, 3 * math.pi / 2], ['N', 'E', 'S', 'W'])
	figure.legend(loc='outside lower center', ncols=3)
	figure.savefig(path, dpi=150)
	return angles[:, 0], angles[:, 1]
