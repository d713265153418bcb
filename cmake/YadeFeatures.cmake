# SPDX-License-Identifier: GPL-2.0-or-later
#
# From the features a YADE binary reports (yade.config.features) to the macros it was compiled with.
# Source of the rules: YADE's CMakeLists.txt, 2025.2.0 (each line here stands for one of its IF(ENABLE_…) blocks).

# feature → macros; a feature without macros has an empty list
set(YADE_MACROS_LOGGER YADE_BOOST_LOG BOOST_LOG_DYN_LINK)
set(YADE_MACROS_USEFUL_ERRORS)
set(YADE_MACROS_COMPLEX_MP YADE_COMPLEX_MP)
set(YADE_MACROS_MPFR YADE_MPFR)
set(YADE_MACROS_MPC)
set(YADE_MACROS_VTK YADE_VTK)
set(YADE_MACROS_OPENMP YADE_OPENMP)
set(YADE_MACROS_GTS YADE_GTS)
set(YADE_MACROS_QT5 YADE_OPENGL YADE_QT5 QT_NO_KEYWORDS)
set(YADE_MACROS_CGAL YADE_CGAL CGAL_DISABLE_ROUNDING_MATH_CHECK)
set(YADE_MACROS_PFVFLOW FLOW_ENGINE)
set(YADE_MACROS_LINSOLV LINSOLV)
set(YADE_MACROS_MPI YADE_MPI)
set(YADE_MACROS_TWOPHASEFLOW TWOPHASEFLOW)
set(YADE_MACROS_SPH YADE_SPH)
set(YADE_MACROS_LS_DEM YADE_LS_DEM)
set(YADE_MACROS_DEFORM YADE_DEFORM)
set(YADE_MACROS_FEMLIKE YADE_FEM)
set(YADE_MACROS_LIQMIGRATION YADE_LIQMIGRATION)
set(YADE_MACROS_GL2PS YADE_GL2PS)
set(YADE_MACROS_LBMFLOW LBM_ENGINE)
set(YADE_MACROS_THERMAL THERMAL)
set(YADE_MACROS_PARTIALSAT PARTIALSAT)
set(YADE_MACROS_PROFILING USE_TIMING_DELTAS ISC_TIMING)
set(YADE_MACROS_POTENTIAL_PARTICLES YADE_POTENTIAL_PARTICLES)
set(YADE_MACROS_POTENTIAL_BLOCKS YADE_POTENTIAL_BLOCKS)
set(YADE_KNOWN_FEATURES
	LOGGER USEFUL_ERRORS COMPLEX_MP MPFR MPC VTK OPENMP GTS QT5 CGAL PFVFLOW LINSOLV MPI TWOPHASEFLOW SPH LS_DEM DEFORM FEMLIKE
	LIQMIGRATION GL2PS LBMFLOW THERMAL PARTIALSAT PROFILING POTENTIAL_PARTICLES POTENTIAL_BLOCKS)

# Known features whose macros cannot be determined from the binary.
set(YADE_REFUSED_ASAN "the plug-in would need the same sanitizer")
set(YADE_REFUSED_FAST_NATIVE "its -march=native cannot be known from the binary")
set(YADE_REFUSED_VECTORIZE "it changes the alignment of all Eigen types")
set(YADE_REFUSED_MASK_ARBITRARY "the number of bits of its masks cannot be known from the binary")
set(YADE_REFUSED_CHOLMOD_GPU "it is not understood")

# yade_definitions(<features> <variable for the macros> <variable for compiler options>)
function(yade_definitions features definitions_variable options_variable)
	set(definitions)
	set(options)
	foreach(feature IN LISTS features)
		if(DEFINED YADE_REFUSED_${feature})
			message(FATAL_ERROR "This YADE has the feature ${feature}, which the plug-in cannot be built for: ${YADE_REFUSED_${feature}}.")
		endif()
		if(NOT feature IN_LIST YADE_KNOWN_FEATURES)
			message(
				FATAL_ERROR
					"This YADE has the feature ${feature}, unknown to cmake/YadeFeatures.cmake. Look up in YADE's CMakeLists.txt which macros "
					"it sets, and add it there.")
		endif()
		list(APPEND definitions ${YADE_MACROS_${feature}})
	endforeach()

	# combinations that YADE's CMakeLists.txt cannot produce: then the list of features is not what we take it for
	foreach(pair "MPFR MPC" "MPC MPFR" "TWOPHASEFLOW PFVFLOW" "THERMAL PFVFLOW" "THERMAL OPENMP" "PARTIALSAT PFVFLOW" "PFVFLOW CGAL")
		separate_arguments(pair)
		list(GET pair 0 one)
		list(GET pair 1 other)
		if(one IN_LIST features AND NOT other IN_LIST features)
			message(FATAL_ERROR "This YADE has the feature ${one} without ${other}: a combination not understood.")
		endif()
	endforeach()

	# Real. The features do not say whether RealHP<N> is there; for double, mpmath is used exactly when it is, and the others
	# cannot do without mpmath.
	if(YADE_REAL_NAME MATCHES "^PrecisionMpfr")
		list(APPEND definitions YADE_REAL_MPFR)
	elseif(NOT YADE_REAL_NAME MATCHES "^Precision(Double|LongDouble|Float128)$")
		message(FATAL_ERROR "This YADE computes with ${YADE_REAL_NAME}; the plug-in can be built for double, long double, float128 and MPFR.")
	endif()
	list(APPEND definitions YADE_REAL_BIT=${YADE_REAL_BIT} YADE_REAL_DEC=${YADE_REAL_DEC})
	if(NOT YADE_MPMATH)
		list(APPEND definitions YADE_DISABLE_REAL_MULTI_HP)
	endif()
	if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|i[3-6]86)$")
		list(APPEND definitions YADE_FLOAT128_UNAVAILABLE)
	endif()

	# set in every build
	list(APPEND definitions YADE_ODEINT MAX_LOG_LEVEL=5 NDEBUG)
	list(APPEND options -ftrack-macro-expansion=0)
	if("OPENMP" IN_LIST features)
		list(APPEND options -fopenmp)
	endif()
	if("CGAL" IN_LIST features)
		list(APPEND options -frounding-math)
	endif()

	set(${definitions_variable} "${definitions}" PARENT_SCOPE)
	set(${options_variable} "${options}" PARENT_SCOPE)
endfunction()
