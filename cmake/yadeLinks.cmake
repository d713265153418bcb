# SPDX-License-Identifier: GPL-2.0-or-later
#
# yade_links(<YADE's prefix> <its library folder> <folder> <folder of programs>): the folder gets symbolic links to all of YADE's library folder, save a plug-in
# that is installed there; the other one links to the programs of this precision. With YADE_PREFIX set to where they lie, YADE runs from there.
# Files that are no links stay.
function(yade_links prefix yade folder programs)
	get_filename_component(name "${yade}" NAME)
	# yade-batch runs the program in the folder bin of YADE_PREFIX
	foreach(kind "" -batch)
		if(EXISTS "${prefix}/bin/${name}${kind}")
			yade_link("${prefix}/bin/${name}${kind}" "${programs}")
		endif()
	endforeach()
	file(GLOB entries "${yade}/*")
	list(FILTER entries EXCLUDE REGEX "/(libpolytope\\.so|polytope-py)$")
	foreach(entry IN LISTS entries)
		yade_link("${entry}" "${folder}")
	endforeach()
endfunction()

function(yade_link target folder)
	get_filename_component(name "${target}" NAME)
	if(EXISTS "${folder}/${name}" AND NOT IS_SYMLINK "${folder}/${name}")
		message(FATAL_ERROR "${folder}/${name} is a file of another YADE: choose an empty folder (--prefix).")
	endif()
	file(MAKE_DIRECTORY "${folder}")
	file(CREATE_LINK "${target}" "${folder}/${name}" SYMBOLIC)
endfunction()
