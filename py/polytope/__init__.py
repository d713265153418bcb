# SPDX-License-Identifier: GPL-2.0-or-later
"""Convex polygons and polyhedra for YADE, after Boon, Houlsby & Utili (2012), Computers and Geotechnics 44:73-82.

A particle is a list of half-spaces a·x ≤ d. Bodies: *fromHalfSpaces*, *fromVertices*, *regular*, *cuboid*, *polygon*, *fromMesh*,
*prism*, *frustum*, *readShapes* (and *writeShapes*); not convex: *clump* (*withoutOverlap*); random grains: *randomGrain*, *grains*, *cloud*; fixed pieces:
*plates*, *tube*, *terrain*; a mesh as YADE's facets: *facets*; a body of an extension's class: *withShape*; a rock mass cut by joints:
*jointedRock* (*readJoints*, *meshRegion*, *regionWithout*; *rockReport*, *scanLine*, *stereonet*, *keyBlocks*); a region cut into Voronoi
cells: *voronoi*. Bonds between faces: *bond*, *bonds*; rock bolts and cables: *bolt* (*Grout*, *Dowel*), *bolts*, *boltArrays*; linings and
beams: *lining* (*Adhesion*); a body broken along a plane: *split*; grains broken by their stress: *breakGrains*. One pair without a scene:
*contact*. The usual engines: *engines*; what is wrong with a scene, and what it pays for unused: *check*; steps with their progress: *run*;
at rest before joints have to bear it: *settle* (*NotAtRest*). Shaken scenes: *baseMotion*, *quietBoundary*, *velocityHistory*. Water in
joints and around blocks: *water*. A rock mass: its initial stress, *inSitu*; blocks taken away, *excavate*; what moves, *history*; its
factor of safety, *factorOfSafety* and *limitAnalysis*. Cost and accuracy of settings: *tradeoff*. Measures: *bodyStress*, *contactFabric*,
*particleFabric*, *porosity*, *coordinationNumber*, *sizeDistribution*, *aabbExtrema*, *mechanicalEnergy*; diagrams: *contactRose*,
*particleRose*, *forceHistogram*. Samples and loading tests: *pack*, *sample*, *triaxial*, *oedometer*, *simpleShear*, *shearBox*. Fields of
all bodies and contacts as NumPy arrays: *arrays*. Saved states: *checkpoint*, *continueFrom*. The scene as a PNG, without a screen:
*picture*; a film of its run: *animate*. The classes (Polytope, Ig2_Polytope_Polytope_PolytopeGeom, RockJointMat, …) are YADE's like any
other.

The C++ side is in the extension module yade._polytope, loaded with YADE itself (pkg/polytope/host/Plugin.cpp).
"""

import builtins

from yade import Quaternion, Vector3
from yade._polytope import buildInfo, contact

from . import _helpTexts
from .bodies.clumps import clump
from .bodies.grains import cloud, grains, randomGrain
from .bodies.meshes import facets, fromMesh
from .bodies.ownShapes import withShape
from .bodies.polytopes import cuboid, fromHalfSpaces, fromVertices, polygon, regular
from .bodies.shapeFiles import readShapes, writeShapes
from .bodies.solids import frustum, plates, prism, tube
from .bodies.terrain import terrain
from .bodies.voronoi import VoronoiCells, voronoi
from .bodies.withoutOverlap import withoutOverlap
from .bonding.bolting import Dowel, Grout, bolt, boltArrays, bolts
from .bonding.bonds import bond, bonds
from .breakage.byStress import breakGrains
from .breakage.splitting import split
from .check import check
from .dynamics.base import baseMotion
from .dynamics.quiet import quietBoundary
from .dynamics.velocityHistory import velocityHistory
from .engines import engines
from .extensions import extensions, load
from .loading.oedometer import oedometer
from .loading.packing import pack, sample
from .loading.shearBox import shearBox
from .loading.simpleShear import simpleShear
from .loading.triaxial import triaxial
from .measures.arrays import arrays
from .measures.coordination import coordinationNumber
from .measures.energy import mechanicalEnergy
from .measures.fabric import contactFabric, particleFabric
from .measures.porosity import porosity
from .measures.roses import contactRose, forceHistogram, particleRose
from .measures.sizes import aabbExtrema, sizeDistribution
from .measures.stress import bodyStress
from .pictures.films import Film, animate
from .pictures.still import picture
from .rest.settling import settle
from .rest.unrest import NotAtRest
from .rock.factorOfSafety import FactorOfSafety, factorOfSafety
from .rock.files import readJoints
from .rock.joint import Joint
from .rock.jointedRock import JointedRock, JointSet, jointedRock
from .rock.keyBlocks import KeyBlock, keyBlocks
from .rock.limit.analysis import LimitAnalysis, limitAnalysis
from .rock.lining import Adhesion, lining
from .rock.nonConvexRegions import meshRegion, regionWithout
from .rock.pointHistories import history
from .rock.report import RockReport, rockReport, scanLine, stereonet
from .rock.stress.excavation import excavate
from .rock.stress.inSitu import inSitu
from .rock.water import water
from .scene.checkpoints import checkpoint, continueFrom
from .scene.running import run
from .scene.timeStep import stableTimeStep
from .tradeoff import tradeoff

__version__ = buildInfo()['version']

# `from yade import *` in plain Python lacks what scripts of the program yade have; YADE itself makes O known in this way
for _name, _class in (('Quaternion', Quaternion), ('Vector3', Vector3)):
	if not hasattr(builtins, _name):
		setattr(builtins, _name, _class)

_helpTexts.rewrite()

__all__ = [
	'Adhesion',
	'Dowel',
	'FactorOfSafety',
	'Film',
	'Grout',
	'Joint',
	'JointSet',
	'JointedRock',
	'KeyBlock',
	'LimitAnalysis',
	'NotAtRest',
	'RockReport',
	'VoronoiCells',
	'aabbExtrema',
	'animate',
	'arrays',
	'baseMotion',
	'bodyStress',
	'bolt',
	'boltArrays',
	'bolts',
	'bond',
	'bonds',
	'breakGrains',
	'buildInfo',
	'check',
	'checkpoint',
	'cloud',
	'clump',
	'contact',
	'contactFabric',
	'contactRose',
	'continueFrom',
	'coordinationNumber',
	'cuboid',
	'engines',
	'excavate',
	'extensions',
	'facets',
	'factorOfSafety',
	'forceHistogram',
	'fromHalfSpaces',
	'fromMesh',
	'fromVertices',
	'frustum',
	'grains',
	'history',
	'inSitu',
	'jointedRock',
	'mechanicalEnergy',
	'keyBlocks',
	'limitAnalysis',
	'lining',
	'load',
	'meshRegion',
	'oedometer',
	'pack',
	'particleFabric',
	'particleRose',
	'picture',
	'plates',
	'polygon',
	'porosity',
	'prism',
	'quietBoundary',
	'randomGrain',
	'readJoints',
	'readShapes',
	'regionWithout',
	'regular',
	'rockReport',
	'run',
	'sample',
	'scanLine',
	'settle',
	'shearBox',
	'simpleShear',
	'sizeDistribution',
	'split',
	'stableTimeStep',
	'stereonet',
	'terrain',
	'tradeoff',
	'triaxial',
	'tube',
	'velocityHistory',
	'voronoi',
	'water',
	'withShape',
	'withoutOverlap',
	'writeShapes',
]
