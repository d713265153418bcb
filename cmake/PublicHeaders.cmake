# SPDX-License-Identifier: GPL-2.0-or-later
#
# polytope_public_headers(<target> SOURCE <folder> PREFIX <name> INTO <folder> HEADERS <names>… [CORE <names>…] [AFTER <target>] [FINGERPRINT <file>]): a target
# that keeps the copies of public headers up to date (publicHeaders.cmake). A list with ; is broken up by a custom command, so | separates names.
function(polytope_public_headers target)
	cmake_parse_arguments(of "" "SOURCE;PREFIX;INTO;AFTER;FINGERPRINT" "HEADERS;CORE" ${ARGN})
	list(JOIN of_HEADERS "|" names)
	list(JOIN of_CORE "|" core)
	set(needed "${of_HEADERS}")
	list(TRANSFORM needed PREPEND "${of_SOURCE}/")
	if(of_AFTER)
		list(APPEND needed ${of_AFTER} "${CMAKE_CURRENT_BINARY_DIR}/${of_AFTER}.copied")
	endif()
	set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${target}.copied")
	add_custom_command(
		OUTPUT "${stamp}"
		BYPRODUCTS ${of_FINGERPRINT}
		COMMAND
			"${CMAKE_COMMAND}" "-DSOURCE=${of_SOURCE}" "-DPREFIX=${of_PREFIX}" "-DINTO=${of_INTO}" "-DHEADERS=${names}" "-DCORE=${core}" "-DSTAMP=${stamp}"
			"-DFINGERPRINT=${of_FINGERPRINT}" -P "${PROJECT_SOURCE_DIR}/cmake/publicHeaders.cmake"
		DEPENDS ${needed} "${PROJECT_SOURCE_DIR}/cmake/publicHeaders.cmake"
		COMMENT "Public headers ${of_PREFIX}/"
		VERBATIM)
	add_custom_target(${target} DEPENDS "${stamp}")
endfunction()
