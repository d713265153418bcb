# SPDX-License-Identifier: GPL-2.0-or-later
#
# Part of the package yade-polytope: yade_polytope_add_extension(<name> SOURCES <files>…), a library with classes for a YADE with this plug-in
# (docs/extending.md). build.cmake has set what the plug-in was built for. YADE_EXECUTABLE, YADE_SOURCE_DIR: program and source tree of the installed YADE, where
# they are not those that the plug-in was built with.

# what cmake/Yade.cmake asks for
set(POLYTOPE_YADE ON)
set(POLYTOPE_PRECISION "${YADE_POLYTOPE_PRECISION}")
if(NOT YADE_EXECUTABLE AND NOT YADE_LIBRARY_DIR)
	set(YADE_EXECUTABLE "${YADE_POLYTOPE_YADE_EXECUTABLE}")
endif()
if(NOT YADE_SOURCE_DIR)
	set(YADE_SOURCE_DIR "${YADE_POLYTOPE_YADE_SOURCE_DIR}")
endif()
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
include(Eigen)
include(Yade)
if(NOT YADE_VERSION STREQUAL YADE_POLYTOPE_YADE_VERSION OR NOT YADE_FEATURES STREQUAL YADE_POLYTOPE_YADE_FEATURES OR NOT POLYTOPE_PRECISION STREQUAL YADE_POLYTOPE_PRECISION)
	message(
		FATAL_ERROR "yade-polytope was built for YADE ${YADE_POLYTOPE_YADE_VERSION} in ${YADE_POLYTOPE_PRECISION} (${YADE_POLYTOPE_YADE_FEATURES}), but YADE ${YADE_VERSION} "
		"in ${POLYTOPE_PRECISION} (${YADE_FEATURES}) is installed in ${YADE_LIBRARY_DIR}: build yade-polytope again first.")
endif()

function(yade_polytope_add_extension name)
	cmake_parse_arguments(PARSE_ARGV 1 of "" "" "SOURCES")
	if(NOT of_SOURCES OR of_UNPARSED_ARGUMENTS)
		message(FATAL_ERROR "yade_polytope_add_extension(<name> SOURCES <files>…): there are no SOURCES, or other arguments: ${of_UNPARSED_ARGUMENTS}")
	endif()
	# what the plug-in reads before it loads the library
	list(JOIN YADE_FEATURES " " features)
	set(extension_name "${name}")
	set(text "${CMAKE_CURRENT_BINARY_DIR}/${name}Extension.cpp")
	configure_file("${YADE_POLYTOPE_CMAKE_DIR}/yadePolytopeExtension.cpp.in" "${text}" @ONLY)

	add_library(${name} MODULE ${of_SOURCES} "${text}")
	set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET default VISIBILITY_INLINES_HIDDEN OFF)
	target_include_directories(${name} SYSTEM PRIVATE "${YADE_POLYTOPE_INCLUDE_DIR}")
	polytope_use_yade(${name})
	# as the plug-in: Eigen's types as YADE has them; and each class has its index from the counter that all have, whatever CMAKE_CXX_FLAGS say
	target_compile_definitions(${name} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT)
	target_compile_options(${name} PRIVATE -fvisibility=default -fno-visibility-inlines-hidden -Wno-psabi)
	target_compile_features(${name} PRIVATE cxx_std_17)
	if(NOT CMAKE_BUILD_TYPE)
		target_compile_options(${name} PRIVATE -O2)
	endif()
	install(TARGETS ${name} LIBRARY DESTINATION "${YADE_POLYTOPE_EXTENSION_DIR}")
endfunction()
