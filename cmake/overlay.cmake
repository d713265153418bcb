# SPDX-License-Identifier: GPL-2.0-or-later
#
# Makes the links of the folder OVERLAY/yade-<precision> anew: to all of YADE_LIBRARY_DIR, and to the plug-in where an installation
# would have it. What is no link stays: it is not ours. PROGRAMS gets links to the programs of this precision. Called by the target `overlay`.
include("${CMAKE_CURRENT_LIST_DIR}/yadeLinks.cmake")
get_filename_component(name "${YADE_LIBRARY_DIR}" NAME)
set(folder "${OVERLAY}/${name}")

file(GLOB entries LIST_DIRECTORIES true "${folder}/*" "${folder}/polytope-py/*")
foreach(entry IN LISTS entries)
	if(IS_SYMLINK "${entry}")
		file(REMOVE "${entry}")
	endif()
endforeach()
file(MAKE_DIRECTORY "${folder}/polytope-py")
yade_links("${YADE_PREFIX}" "${YADE_LIBRARY_DIR}" "${folder}" "${PROGRAMS}") # without an installed plug-in: this one takes its place

file(CREATE_LINK "${GATE}" "${folder}/libpolytope.so" SYMBOLIC)
file(CREATE_LINK "${CLASSES}" "${folder}/polytope-py/_polytope.so" SYMBOLIC)
file(CREATE_LINK "${PYTHON_PACKAGE}" "${folder}/polytope-py/polytope" SYMBOLIC)
