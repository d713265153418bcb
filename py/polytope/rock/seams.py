# SPDX-License-Identifier: GPL-2.0-or-later
"""Rock goes on across the seams of a region: faces that its convex parts share, and that no joint has made."""

import dataclasses

import numpy as np
import scipy
from yade import _polytope

from ..arguments import numbersOf, vectors
from ..precision import real
from .joint import asArguments

__all__ = ['joinedAcrossSeams']

onePlane = 1e-6
"""Difference of unit normals, and of offsets over the region's radius, below which two planes may be a seam. It only chooses the blocks
that are looked at; the core decides by its own tolerance, which is smaller."""


def joinedAcrossSeams(made, bodyOf, cuts, region, bridge):
	"""The body of each block where joints cut wholly: blocks that meet in a seam are one.

	The core groups the blocks, as parts of a region that joints without bounds cut no further.

	:param made: what _polytope.jointedBlocks returned for the region's parts
	:param bodyOf: number of the body of each block
	:param cuts: joints about the region's centre
	:param float bridge: share of the smaller face over which rock must go on
	:returns: number of the body of each block
	"""
	planes, labels = np.frombuffer(made['planes']).reshape(-1, 4), np.frombuffer(made['labels'], np.int32)
	counts = np.frombuffer(made['counts'], np.int32)
	owner = np.repeat(np.arange(len(counts)), counts)
	own = labels < 0
	scaled = planes[own] / [1, 1, 1, region.radius]
	apart, _ = scipy.spatial.cKDTree(scaled).query(-scaled, distance_upper_bound=onePlane)
	chosen = np.unique(owner[own][np.isfinite(apart)])
	if not len(chosen):
		return bodyOf
	ends = np.cumsum(counts)
	blocks = [planes[end - counts[k] : end] for k, end in zip(chosen, ends[chosen], strict=True)]
	parts = [(vectors(block[:, :3], 'normals', 3), numbersOf(block[:, 3], 'offsets')) for block in blocks]
	endless = [dataclasses.replace(cut, radius=0.0, edges=np.empty((0, 4))) for cut in cuts]
	uncut = real(2 * region.inscribedRadius)  # no piece holds a ball of this size, so joints cut nothing
	again = _polytope.jointedBlocks(parts, asArguments(endless), uncut, real(bridge), len(counts), 0)
	joined, first = bodyOf.copy(), {}
	for block, group in zip(chosen.tolist(), np.frombuffer(again['bodies'], np.int32).tolist(), strict=True):
		joined[block] = joined[first.setdefault(group, block)]
	return np.unique(joined, return_inverse=True)[1]
