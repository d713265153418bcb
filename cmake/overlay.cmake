# SPDX-License-Identifier: GPL-2.0-or-later
#
# Makes the folder OVERLAY/yade-<precision> anew: links to all of YADE_LIBRARY_DIR, and to the plug-in where an installation
# would have it. PROGRAMS gets links to the programs of this precision. Called by the target `overlay`.
get_filename_component(name "${YADE_LIBRARY_DIR}" NAME)
set(folder "${OVERLAY}/${name}")

# yade-batch runs the program in the folder bin of YADE_PREFIX
find_program(program NAMES "${name}" NO_CACHE)
if(program)
	foreach(kind "" -batch)
		if(EXISTS "${program}${kind}")
			file(MAKE_DIRECTORY "${PROGRAMS}")
			file(CREATE_LINK "${program}${kind}" "${PROGRAMS}/${name}${kind}" SYMBOLIC)
		endif()
	endforeach()
endif()

file(REMOVE_RECURSE "${folder}")
file(MAKE_DIRECTORY "${folder}/polytope-py")

# without an installed plug-in: this one takes its place
file(GLOB entries "${YADE_LIBRARY_DIR}/*")
foreach(entry IN LISTS entries)
	get_filename_component(name "${entry}" NAME)
	if(NOT name MATCHES "^(libpolytope\\.so|polytope-py)$")
		file(CREATE_LINK "${entry}" "${folder}/${name}" SYMBOLIC)
	endif()
endforeach()

file(CREATE_LINK "${GATE}" "${folder}/libpolytope.so" SYMBOLIC)
file(CREATE_LINK "${CLASSES}" "${folder}/polytope-py/_polytope.so" SYMBOLIC)
file(CREATE_LINK "${PYTHON_PACKAGE}" "${folder}/polytope-py/polytope" SYMBOLIC)
