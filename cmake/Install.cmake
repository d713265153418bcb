# SPDX-License-Identifier: GPL-2.0-or-later
#
# `cmake --install`: into the installed YADE itself, whose prefix is the default one. Under another --prefix links to YADE's libraries lie beside the
# plug-in, and YADE runs with it where YADE_PREFIX names that prefix. DESTDIR holds for both. `cmake -P uninstall.cmake` in the build
# folder removes it all. Components: plugin (what runs) and doc.
set(plugin_dir "${YADE_INSTALL_DIR}/polytope-py")

# else files of an earlier version would remain beside the new ones
install(CODE "file(REMOVE_RECURSE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${plugin_dir}\")" COMPONENT plugin)
install(TARGETS polytope_gate LIBRARY DESTINATION "${YADE_INSTALL_DIR}" COMPONENT plugin)
install(TARGETS polytope_classes LIBRARY DESTINATION "${plugin_dir}" COMPONENT plugin)
install(
	DIRECTORY "${PROJECT_SOURCE_DIR}/py/polytope/"
	DESTINATION "${plugin_dir}/polytope"
	COMPONENT plugin
	FILES_MATCHING PATTERN "*.py"
	PATTERN "__pycache__" EXCLUDE)
install(
	CODE "
	if(NOT CMAKE_INSTALL_PREFIX STREQUAL \"${YADE_PREFIX}\")
		include(\"${PROJECT_SOURCE_DIR}/cmake/yadeLinks.cmake\")
		set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
		yade_links(\"${YADE_PREFIX}\" \"${YADE_LIBRARY_DIR}\" \"\${prefix}/${YADE_INSTALL_DIR}\" \"\${prefix}/bin\")
	endif()"
	COMPONENT plugin)

install(CODE "file(REMOVE_RECURSE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")" COMPONENT doc)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc)
install(
	DIRECTORY docs examples
	DESTINATION "${CMAKE_INSTALL_DOCDIR}"
	COMPONENT doc
	FILES_MATCHING
	PATTERN "*.md"
	PATTERN "*.png"
	PATTERN "*.py"
	PATTERN "*.obj" # a mesh that one of them reads
	PATTERN "__pycache__" EXCLUDE
	PATTERN "output" EXCLUDE
	PATTERN "paper" EXCLUDE) # the reproduction is no part of what is installed

configure_file(cmake/uninstall.cmake.in uninstall.cmake @ONLY)
