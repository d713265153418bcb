# SPDX-License-Identifier: GPL-2.0-or-later
#
# YADE's own polyhedra, which Debian's YADE is built without: libyadepeer_potentialblock.so and libyadepeer_polyhedra.so,
# compiled as they are from YADE's source tree (YADE_SOURCE_DIR) into plug-ins. `yadePeers` builds both.

# Each as one translation unit: the headers of YADE and CGAL take longer than all of the rest.
function(yade_peer name)
	list(TRANSFORM ARGN PREPEND "${YADE_SOURCE_DIR}/pkg/")
	add_library(pkg_${name} MODULE EXCLUDE_FROM_ALL ${ARGN})
	polytope_use_yade(pkg_${name})
	target_compile_definitions(pkg_${name} PRIVATE $<TARGET_PROPERTY:polytope_options,INTERFACE_COMPILE_DEFINITIONS>)
	target_compile_options(pkg_${name} PRIVATE -O3 -w) # as YADE's own release build; its warnings are not for this project to fix
	set_target_properties(pkg_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0 PREFIX lib OUTPUT_NAME yadepeer_${name} BUILD_RPATH "${YADE_LIBRARY_DIR}")
endfunction()

yade_peer(potentialblock
	potential/PotentialBlock.cpp potential/PotentialBlock2AABB.cpp potential/Ig2_PB_PB_ScGeom.cpp potential/KnKsPBLaw.cpp)
find_path(CLP_INCLUDE_DIR ClpSimplex.hpp PATH_SUFFIXES coin coin-or REQUIRED)
find_package(LAPACK REQUIRED)
target_compile_definitions(pkg_potentialblock PRIVATE YADE_POTENTIAL_BLOCKS)
target_include_directories(pkg_potentialblock SYSTEM PRIVATE "${CLP_INCLUDE_DIR}")
target_link_libraries(pkg_potentialblock PRIVATE "${CLP_LIBRARY}" "${COINUTILS_LIBRARY}" LAPACK::LAPACK)

yade_peer(polyhedra
	polyhedra/Polyhedra_01.cpp polyhedra/Polyhedra_Ig2.cpp polyhedra/Polyhedra_support.cpp polyhedra/Polyhedra_splitter.cpp
	polyhedra/Polyhedra_02.cpp)
set_source_files_properties("${YADE_SOURCE_DIR}/pkg/polyhedra/Polyhedra_02.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_compile_definitions(pkg_polyhedra PRIVATE YADE_CGAL CGAL_DISABLE_ROUNDING_MATH_CHECK)
target_compile_options(pkg_polyhedra PRIVATE -frounding-math)
target_link_libraries(pkg_polyhedra PRIVATE mpfr gmp "${YADE_LIBRARY_DIR}/libpre_dem.so") # CGAL is headers only

add_custom_target(yadePeers DEPENDS pkg_potentialblock pkg_polyhedra)
