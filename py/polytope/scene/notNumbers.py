# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies whose motion is not a number."""

import numpy as np
from yade import _polytope

from .columns import arraysOf

__all__ = ['notNumbers']

columns = {'pos': 'positions', 'ori': 'orientations', 'vel': 'velocities', 'angVel': 'angularVelocities'}


def notNumbers():
	"""{number of a body: the attributes of its state that are not finite}, in the order of their numbers; clumps, too, whose members follow them."""
	bodies = arraysOf(_polytope.bodyColumns()[0])
	lost = {name: ~np.isfinite(bodies[column]).all(axis=1) for name, column in columns.items()}
	return {int(bodies['ids'][row]): [name for name in lost if lost[name][row]] for row in np.flatnonzero(np.any(list(lost.values()), axis=0))}
