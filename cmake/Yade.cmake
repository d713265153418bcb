# SPDX-License-Identifier: GPL-2.0-or-later
#
# Finds the installed YADE and the way to compile against it: Debian's of POLYTOPE_PRECISION, or the one whose program YADE_EXECUTABLE names.
#
# YADE ships no headers and no CMake package. Its source tree of exactly the installed version serves instead, compiled
# with exactly the macros of the binary: a macro missing or too many changes the layout of classes, and the first contact
# crashes without a message of compiler or linker. So the macros are derived from the features the binary reports, by the
# rules of YADE's own CMakeLists.txt, and what is not understood is refused.
#
# Sets YADE_FOUND, YADE_VERSION, YADE_FEATURES, YADE_LIBRARY_DIR (…/yade-double: YADE_PREFIX/YADE_INSTALL_DIR), YADE_REAL_BIT, YADE_DEFINITIONS; the function
# polytope_use_yade(<target>) gives a target all it needs. cmake/YadeFeatures.cmake has the rules.

include(YadeFeatures)

set(YADE_FOUND FALSE)

# ends the search: an error where the plug-in was asked for, else a message
macro(yade_not_usable)
	if(POLYTOPE_YADE STREQUAL "AUTO" AND NOT YADE_EXECUTABLE)
		message(STATUS "Plug-in: not built, the core alone is. ${ARGN}")
		return()
	endif()
	message(FATAL_ERROR ${ARGN})
endmacro()

if(NOT POLYTOPE_YADE)
	message(STATUS "Plug-in: not built, as asked for (POLYTOPE_YADE=${POLYTOPE_YADE})")
	return()
endif()

if(YADE_EXECUTABLE)
	include(YadeProgram)
endif()
find_package(Python3 COMPONENTS Interpreter Development.Module)
if(NOT Python3_FOUND)
	yade_not_usable("Python with its headers was not found.")
endif()

find_path(
	YADE_LIBRARY_DIR py/yade/config.py
	PATHS /usr/lib /usr/local/lib
	PATH_SUFFIXES "${CMAKE_LIBRARY_ARCHITECTURE}/yade-${POLYTOPE_PRECISION}" "yade-${POLYTOPE_PRECISION}"
	NO_DEFAULT_PATH
	DOC "YADE's library folder")
if(NOT YADE_LIBRARY_DIR)
	yade_not_usable(
		"Debian's YADE of precision `${POLYTOPE_PRECISION}` is not installed. For a YADE that you built, name its program: "
		"-DYADE_EXECUTABLE=…/bin/yade-….")
endif()

execute_process(
	COMMAND "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_LIST_DIR}/yadeConfig.py" "${YADE_LIBRARY_DIR}/py/yade/config.py"
	OUTPUT_VARIABLE yade_config
	RESULT_VARIABLE yade_config_result
	ERROR_VARIABLE yade_config_error)
if(NOT yade_config_result EQUAL 0)
	message(FATAL_ERROR "Cannot read ${YADE_LIBRARY_DIR}/py/yade/config.py:\n${yade_config_error}")
endif()
foreach(name VERSION FEATURES REAL_BIT REAL_DEC REAL_NAME LIBRARY_PATH MPMATH SOURCE_ROOT)
	string(REGEX MATCH "(^|\n)${name}=([^\n]*)" line "${yade_config}")
	set(YADE_${name} "${CMAKE_MATCH_2}")
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${YADE_LIBRARY_DIR}/py/yade/config.py")

# YADE_PREFIX/YADE_INSTALL_DIR is the library folder: where YADE looks for it
get_filename_component(name "${YADE_LIBRARY_DIR}" NAME)
set(YADE_INSTALL_DIR "${YADE_LIBRARY_PATH}/${name}")
string(FIND "${YADE_LIBRARY_DIR}" "/${YADE_INSTALL_DIR}" end REVERSE)
if(end LESS 1)
	yade_not_usable("YADE's library folder is ${YADE_LIBRARY_DIR}, but by its own config.py it should end with ${YADE_INSTALL_DIR}.")
endif()
string(SUBSTRING "${YADE_LIBRARY_DIR}" 0 ${end} YADE_PREFIX)

if(YADE_EXECUTABLE)
	string(TOLOWER "${YADE_REAL_NAME}" POLYTOPE_PRECISION)
	string(REGEX REPLACE "^precision" "" POLYTOPE_PRECISION "${POLYTOPE_PRECISION}") # PrecisionLongDouble: longdouble
endif()

if(YADE_VERSION VERSION_LESS 2025)
	yade_not_usable("YADE ${YADE_VERSION} is in ${YADE_LIBRARY_DIR}; 2025.2.0 and newer are supported.")
endif()
if(NOT YADE_SOURCE_DIR AND EXISTS "${YADE_SOURCE_ROOT}/core/Scene.hpp")
	set(YADE_SOURCE_DIR "${YADE_SOURCE_ROOT}") # where it was built
endif()
if(NOT EXISTS "${YADE_SOURCE_DIR}/core/Scene.hpp")
	yade_not_usable(
		"YADE ${YADE_VERSION} is in ${YADE_LIBRARY_DIR}, but its source tree is needed for the headers: set YADE_SOURCE_DIR "
		"(`./run build` fetches it for Debian's YADE).")
endif()
if(NOT EXISTS "${YADE_SOURCE_DIR}/RELEASE")
	yade_not_usable("${YADE_SOURCE_DIR} has no file RELEASE, as YADE's releases have: its version cannot be compared with the installed YADE ${YADE_VERSION}. Releases alone are supported.")
endif()
file(STRINGS "${YADE_SOURCE_DIR}/RELEASE" yade_source_version LIMIT_COUNT 1)
if(NOT yade_source_version STREQUAL YADE_VERSION)
	message(
		FATAL_ERROR
			"YADE ${YADE_VERSION} is installed in ${YADE_LIBRARY_DIR}, but ${YADE_SOURCE_DIR} is the source of ${yade_source_version}. "
			"They must be the same version: classes differ between versions.")
endif()

yade_definitions("${YADE_FEATURES}" YADE_DEFINITIONS YADE_OPTIONS)

# For the test of the load-time check alone: compiles with one macro missing, as a wrong build would.
set(POLYTOPE_TEST_WITHOUT_MACRO "" CACHE STRING "For a test of the layout check: leave out this macro of YADE's")
mark_as_advanced(POLYTOPE_TEST_WITHOUT_MACRO)
if(POLYTOPE_TEST_WITHOUT_MACRO)
	list(REMOVE_ITEM YADE_DEFINITIONS "${POLYTOPE_TEST_WITHOUT_MACRO}")
endif()

list(JOIN YADE_FEATURES " " yade_features_text)
message(STATUS "YADE ${YADE_VERSION} in ${YADE_LIBRARY_DIR}: ${yade_features_text}")

include(YadeHeaders)
set(YADE_FOUND TRUE)
