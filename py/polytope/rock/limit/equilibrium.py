# SPDX-License-Identifier: GPL-2.0-or-later
"""Equilibrium of rigid blocks under forces at the corners of their common faces."""

import numpy as np
from scipy import sparse

__all__ = ['Equilibrium']

leastPivot = 1e-13
"""Part of its diagonal that is added to a matrix in which rounding has left no positive pivot; a hundred times as much at each further try."""
tries = 5


class Equilibrium:
	"""A: forces at corners → resultants of the blocks, six for each: force, and moment over a length about its centre.

	Forces are rows (normal, two across) in the frame of their face, of block *one* on block *two*.

	:param blocks: *Blocks*
	:param corners: *Corners*
	:param float length: that makes moments forces [m]
	"""

	def __init__(self, blocks, corners, length):
		self.size = 6 * len(blocks.ids)
		self.free = blocks.free.reshape(-1)
		self.sides = [(-1.0, corners.one), (1.0, corners.two)]
		self.middles = corners.middles
		self.face = corners.face
		arms = (corners.places - self.middles[self.face]) / length
		self.atFace = np.concatenate([corners.frames, np.cross(arms[:, :, None], corners.frames, axis=1)], axis=1)
		"""(corners, 6, 3) wrench about the face's middle of each component"""
		self.onBlock = [self._onBlock(blocks, block, length) for _, block in self.sides]
		self.matrix = self._matrix()
		self.transposed = self.matrix.T.tocsr()
		self._order()

	def _onBlock(self, blocks, block, length):
		"""(faces, 6, 6): wrench about the face's middle → about the block's centre, without components along which it cannot move."""
		arm = (self.middles - blocks.centres[block]) / length
		move = np.tile(np.eye(6), (len(block), 1, 1))
		move[:, 3:, :3] = np.cross(arm[:, :, None], np.eye(3)[None], axis=1)
		return move * (blocks.free[block] & (block >= 0)[:, None])[:, :, None]

	def _matrix(self):
		rows, columns, values = [], [], []
		for (sign, block), onBlock in zip(self.sides, self.onBlock, strict=True):
			held = np.flatnonzero(block[self.face] >= 0)
			of = self.face[held]
			entries = sign * onBlock[of] @ self.atFace[held]
			rows.append(np.broadcast_to((6 * block[of])[:, None, None] + np.arange(6)[:, None], entries.shape).ravel())
			columns.append(np.broadcast_to((3 * held)[:, None, None] + np.arange(3), entries.shape).ravel())
			values.append(entries.ravel())
		shape = self.size, 3 * len(self.face)
		matrix = sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape)
		matrix.eliminate_zeros()
		return matrix

	def resultants(self, forces):
		return self.matrix @ forces.ravel()

	def slips(self, motion):
		"""How far block *two* moves against block *one* at each corner, in the face's frame."""
		return (self.transposed @ motion).reshape(-1, 3)

	def _order(self):
		"""Where each face's 6 × 6 block goes in the lower half of the symmetric matrix, by columns."""
		count, faces = self.size // 6, len(self.middles)
		(_, one), (_, two) = self.sides
		self.perFace = sparse.csr_matrix((np.ones(len(self.face)), (self.face, np.arange(len(self.face)))), (faces, len(self.face)))
		self.perBlock = [
			sparse.csr_matrix((np.ones(held.sum()), (block[held], np.flatnonzero(held))), (count, faces))
			for block, held in ((one, one >= 0), (two, two >= 0))
		]
		self.between = np.flatnonzero((one >= 0) & (two >= 0))
		a, b = one[self.between], two[self.between]
		self.turned = a > b  # the row is the larger one
		pairs, self.pair = np.unique(np.minimum(a, b) * count + np.maximum(a, b), return_inverse=True)
		self.perPair = sparse.csr_matrix(
			(np.ones(len(self.between)), (self.pair, np.arange(len(self.between)))), (len(pairs), len(self.between))
		)
		low, high = pairs // count, pairs % count
		six = np.arange(6)
		self.lower = np.tril_indices(6)
		rows = [
			(6 * np.arange(count)[:, None] + self.lower[0]).ravel(),
			np.broadcast_to(6 * high[:, None, None] + six[:, None], (len(pairs), 6, 6)).ravel(),
		]
		columns = [
			(6 * np.arange(count)[:, None] + self.lower[1]).ravel(),
			np.broadcast_to(6 * low[:, None, None] + six, (len(pairs), 6, 6)).ravel(),
		]
		rows, columns = np.concatenate(rows), np.concatenate(columns)
		self.order = np.lexsort((rows, columns))
		self.rows, self.columns = rows[self.order], columns[self.order]
		self.symmetric, self.symbolic = None, None

	def factorise(self, flexibilities):
		"""Solver of A F Aᵀ y = b for symmetric positive (corners, 3, 3) blocks of F: a function of b, (size,) or (size, n)."""
		try:
			from cvxopt import cholmod, matrix, spmatrix  # loaded by the first call alone
		except ImportError as error:
			raise ImportError(
				f'polytope.limitAnalysis needs the package python3-cvxopt; sudo apt install python3-cvxopt ({error})'
			) from None

		faces = (self.perFace @ (self.atFace @ flexibilities @ self.atFace.transpose(0, 2, 1)).reshape(-1, 36)).reshape(-1, 6, 6)
		one, two = (move @ faces @ move.transpose(0, 2, 1) for move in self.onBlock)
		own = sum(per @ part.reshape(-1, 36) for per, part in zip(self.perBlock, (one, two), strict=True)).reshape(-1, 6, 6)
		diagonal = np.einsum('nii->ni', own)
		diagonal += np.where(self.free.reshape(-1, 6), 0, 1)
		first, second = (move[self.between] for move in self.onBlock)
		cross = -second @ faces[self.between] @ first.transpose(0, 2, 1)  # row: two, column: one
		cross[self.turned] = cross[self.turned].transpose(0, 2, 1)
		cross = self.perPair @ cross.reshape(-1, 36)
		values = np.concatenate([own[:, self.lower[0], self.lower[1]].ravel(), cross.ravel()])[self.order]
		if self.symmetric is None:
			self.symmetric = spmatrix(matrix(values), matrix(self.rows), matrix(self.columns), (self.size, self.size))
			self.symbolic = cholmod.symbolic(self.symmetric)
			self.onDiagonal = np.flatnonzero(self.rows == self.columns)
		more = 0.0
		for _ in range(tries):
			shifted = values.copy()
			shifted[self.onDiagonal] *= 1 + more
			self.symmetric.V = matrix(shifted)
			try:
				cholmod.numeric(self.symmetric, self.symbolic)
				break
			except ArithmeticError:
				more = max(leastPivot, 100 * more)
		else:
			raise ArithmeticError('no positive pivot')

		def solve(right):
			found = matrix(np.ascontiguousarray(right.reshape(self.size, -1)))
			cholmod.solve(self.symbolic, found)
			return np.array(found).reshape(right.shape)

		return solve
