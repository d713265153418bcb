# SPDX-License-Identifier: GPL-2.0-or-later
"""yade.mpy's own decomposition, mpy.DOMAIN_DECOMPOSITION, in place of divide(): set right for fixed bodies and clumps."""

from yade import O

from .clumps import followClumps

__all__ = ['prepare']


def prepare():
	"""Before yade.mpy decomposes the scene, on rank 0. It leaves walls, boxes and facets with rank 0, and the subdomain of others to itself; fixed
	polytopes belong to rank 0, too, and members of clumps to the rank of their clump, which has the place of the clump's centre."""
	from yade import bisectionDecomposition  # starts to write errors to the standard output

	if not hasattr(bisectionDecomposition.decompBodiesSerial, 'bodiesAreOurs'):
		bisectionDecomposition.decompBodiesSerial = _derived(bisectionDecomposition.decompBodiesSerial)
	for body in O.bodies:
		if not body.dynamic:
			body.subdomain = 0


def _derived(base):
	class Decomposition(base):
		bodiesAreOurs = True

		def checkIfMasterBody(self, body):
			return not body.dynamic or body.isSubdomain or body.isClumpMember

		def partitionDomain(self, *arguments):
			super().partitionDomain(*arguments)
			followClumps()

	return Decomposition
