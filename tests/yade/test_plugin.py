# SPDX-License-Identifier: GPL-2.0-or-later
"""The plug-in is loaded with YADE, and is the one compiled for it."""
import yade
from yade import polytope


def testCompiledForThisYade():
	info = polytope.buildInfo()
	assert info['yadeVersion'] == yade.config.version
	assert info['yadeFeatures'] == yade.config.features
	assert info['precision'] == 'double'
