# SPDX-License-Identifier: GPL-2.0-or-later
#
# Copies public headers to where other projects include them, below one folder of a name of its own. Called by cmake/PublicHeaders.cmake at build time:
#   SOURCE   folder that their names are relative to        PREFIX   the folder's name in includes: #include <PREFIX/shape/….hpp>
#   HEADERS  their names, separated by |                     INTO     the folder that PREFIX is made in
#   CORE     the core's public headers, for those of the plug-in, which include them as <src/…>; there they are <polytope/…>
# What a public header includes of ours must be public, too: else this stops. STAMP is touched in the end; FINGERPRINT,
# if given, becomes a header with a sum of all of them.
cmake_policy(VERSION 3.22)
string(REPLACE "|" ";" headers "${HEADERS}")
string(REPLACE "|" ";" core "${CORE}")
set(written)

# what `name` includes, as other projects include it: sets `result`
function(as_public name)
	file(READ "${SOURCE}/${name}" text)
	string(REGEX MATCHALL "#include \"[^\"]+\"" own "${text}")
	string(REGEX MATCHALL "#include <src/[^>]+>" of_core "${text}")
	foreach(include IN LISTS own)
		string(REGEX REPLACE "#include \"(.+)\"" "\\1" included "${include}")
		if(NOT included IN_LIST headers)
			message(FATAL_ERROR "${name} is public and includes ${included}, which is not: see the list of public headers.")
		endif()
		string(REPLACE "${include}" "#include <${PREFIX}/${included}>" text "${text}")
	endforeach()
	foreach(include IN LISTS of_core)
		string(REGEX REPLACE "#include <src/(.+)>" "\\1" included "${include}")
		if(NOT included IN_LIST core)
			message(FATAL_ERROR "${name} is public and includes ${included} of the core, which is not: see the list in cmake/CoreLibrary.cmake.")
		endif()
		string(REPLACE "${include}" "#include <polytope/${included}>" text "${text}")
	endforeach()
	set(result "${text}" PARENT_SCOPE)
endfunction()

foreach(name IN LISTS headers)
	as_public("${name}")
	set(file "${INTO}/${PREFIX}/${name}")
	list(APPEND written "${file}")
	set(before)
	if(EXISTS "${file}")
		file(READ "${file}" before)
	endif()
	if(NOT before STREQUAL result)
		file(WRITE "${file}" "${result}")
	endif()
endforeach()

# those of an earlier version
file(GLOB_RECURSE there "${INTO}/${PREFIX}/*")
foreach(file IN LISTS there)
	get_filename_component(name "${file}" NAME)
	if(NOT file IN_LIST written AND NOT name STREQUAL "config.hpp" AND NOT name STREQUAL "Fingerprint.hpp")
		file(REMOVE "${file}")
	endif()
endforeach()

# of all headers that other projects see: the plug-in and an extension must have been compiled with the same
if(FINGERPRINT)
	file(GLOB_RECURSE there "${INTO}/*.hpp")
	list(REMOVE_ITEM there "${FINGERPRINT}")
	list(SORT there)
	set(text)
	foreach(file IN LISTS there)
		file(READ "${file}" one)
		string(APPEND text "${one}")
	endforeach()
	string(SHA256 hash "${text}")
	file(CONFIGURE OUTPUT "${FINGERPRINT}" CONTENT "// Written by CMake: of the headers beside this one.\n#define YADE_POLYTOPE_FINGERPRINT \"${hash}\"\n" @ONLY)
endif()
file(TOUCH "${STAMP}")
