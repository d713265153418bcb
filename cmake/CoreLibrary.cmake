# SPDX-License-Identifier: GPL-2.0-or-later
#
# The core for other programs: find_package(polytope-core), or add_subdirectory of this project, gives them polytope::core, a shared library with the public
# headers as <polytope/…>. Nothing else of ours reaches the program: no options of the compiler, no warnings, no YADE. docs/core-library.md has its use.
# Included by src/CMakeLists.txt. In YADE's wider precisions there is none: its numbers are YADE's, which programs do not have.
include(PublicHeaders)

# A header is public if a program that makes shapes and asks for contacts includes it (first list), or if one of those does (second list). All others may change
# at any time.
set(POLYTOPE_CORE_HEADERS
	contact/ContactQuery.hpp # a contact
	contact/ContactTypes.hpp # its input and output
	contact/LinearContact.hpp # a contact whose bodies hardly move
	contact/PlacedPair.hpp # its two bodies
	contact/PairDistance.hpp # distance and nearest points of two shapes
	contact/Preconditions.hpp # what a contact needs of its input
	contact/Status.hpp # how it ended
	numbers/Real.hpp # numbers and vectors
	shape/ClosestPoint.hpp # distance of a point
	shape/ConvexShape.hpp # a shape
	shape/HalfSpaces.hpp # planes
	shape/MassProperties.hpp
	shape/PlacedShape.hpp
	shape/RoundedSolid.hpp # sum of a polyhedron and a ball
	shape/ShapeConstruction.hpp # vertices and faces of planes, hull of points
	shape/ShapeFactory.hpp # shape and pose of planes or points
	# which those include
	numbers/Export.hpp # contact/, shape/
	numbers/Lanes.hpp # LpBasis
	numbers/Tolerances.hpp # defaults of ContactSettings
	program/LpBasis.hpp # ConvexShape keeps that of its inscribed ball
	program/PlaneCode.hpp # PairMemory and ContactResult have planes by their codes
	joint/ClosureLaw.hpp # ContactSettings may have one
	surface/KeptVertices.hpp # PairMemory keeps them
	surface/SurfaceTolerances.hpp # KeptVertices has room for as many
)

if(NOT POLYTOPE_PRECISION STREQUAL "double")
	return()
endif()
set(core_include "${PROJECT_BINARY_DIR}/include/polytope-core")
polytope_public_headers(polytope_core_headers SOURCE "${PROJECT_SOURCE_DIR}/src" PREFIX polytope INTO "${core_include}" HEADERS ${POLYTOPE_CORE_HEADERS})
configure_file("${PROJECT_BINARY_DIR}/generated/polytope/config.hpp" "${core_include}/polytope/config.hpp" COPYONLY)

# the same objects: the kernels are as the plug-in has them
add_library(polytope_core_library SHARED $<TARGET_OBJECTS:polytope_core>)
add_library(polytope::core ALIAS polytope_core_library)
add_dependencies(polytope_core_library polytope_core_headers)
set_target_properties(
	polytope_core_library PROPERTIES OUTPUT_NAME polytope-core EXPORT_NAME core VERSION ${PROJECT_VERSION} SOVERSION ${polytope_abi} LINKER_LANGUAGE CXX)
target_include_directories(
	polytope_core_library SYSTEM INTERFACE "$<BUILD_INTERFACE:${core_include}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/polytope-core>")
target_compile_features(polytope_core_library INTERFACE cxx_std_17)
target_link_libraries(polytope_core_library INTERFACE Eigen3::Eigen PRIVATE $<TARGET_PROPERTY:polytope_core,LINK_LIBRARIES>)

# Component core. Beside the plug-in, and as part of another project, `cmake --install` takes it only where it is asked for: --component core.
set(unless_asked)
if(YADE_FOUND OR NOT PROJECT_IS_TOP_LEVEL)
	set(unless_asked EXCLUDE_FROM_ALL)
endif()
set(core_cmake "${CMAKE_INSTALL_LIBDIR}/cmake/polytope-core")
include(CMakePackageConfigHelpers)
configure_package_config_file(
	"${PROJECT_SOURCE_DIR}/cmake/polytope-core-config.cmake.in" "${PROJECT_BINARY_DIR}/cmake/polytope-core-config.cmake" INSTALL_DESTINATION "${core_cmake}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cmake/polytope-core-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(CODE "file(REMOVE_RECURSE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/polytope-core\")" COMPONENT core ${unless_asked})
install(DIRECTORY "${core_include}/polytope" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/polytope-core" COMPONENT core ${unless_asked})
install(
	TARGETS polytope_core_library
	EXPORT polytope-core
	LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT core ${unless_asked})
install(EXPORT polytope-core FILE polytope-core-targets.cmake NAMESPACE polytope:: DESTINATION "${core_cmake}" COMPONENT core ${unless_asked})
install(
	FILES "${PROJECT_BINARY_DIR}/cmake/polytope-core-config.cmake" "${PROJECT_BINARY_DIR}/cmake/polytope-core-config-version.cmake"
	DESTINATION "${core_cmake}"
	COMPONENT core ${unless_asked})
