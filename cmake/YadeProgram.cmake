# SPDX-License-Identifier: GPL-2.0-or-later
#
# What the program YADE_EXECUTABLE of a YADE that somebody has built tells: its library folder, YADE_LIBRARY_DIR, and its Python. Part of Yade.cmake.
#
# The program is a script in Python, PREFIX/bin/yade<suffix>. Its libraries are in PREFIX/<libPATH>/yade<suffix>.
file(REAL_PATH "${YADE_EXECUTABLE}" yade_program)
set(line)
if(EXISTS "${yade_program}" AND NOT IS_DIRECTORY "${yade_program}")
	file(STRINGS "${yade_program}" line REGEX "^libPATH='[^']+'$" LIMIT_COUNT 1)
endif()
if(NOT line)
	yade_not_usable("YADE_EXECUTABLE=${YADE_EXECUTABLE} is not YADE's program. Name the file that you start YADE with, for example $ENV{HOME}/yade/install/bin/yade-2025.2.0.")
endif()
string(REGEX REPLACE "^libPATH='(.+)'$" "\\1" path "${line}")
get_filename_component(name "${yade_program}" NAME)
get_filename_component(folder "${yade_program}/../../${path}/${name}" ABSOLUTE)
if(NOT EXISTS "${folder}/py/yade/config.py")
	yade_not_usable("The libraries of YADE_EXECUTABLE=${YADE_EXECUTABLE} are not in ${folder}: name the program that YADE's `make install` has put beside them.")
endif()
set(YADE_LIBRARY_DIR "${folder}" CACHE PATH "YADE's library folder" FORCE)

# the Python that runs it, of which Boost.Python and the headers must be
file(STRINGS "${yade_program}" line REGEX "^#!" LIMIT_COUNT 1)
string(REGEX REPLACE "^#! *" "" line "${line}")
if(NOT Python3_EXECUTABLE AND EXISTS "${line}")
	set(Python3_EXECUTABLE "${line}")
endif()
