# SPDX-License-Identifier: GPL-2.0-or-later
#
# What extensions of others are built with: the package yade-polytope for CMake, and the headers below include/yade-polytope-<precision>, those of the core beside
# those of the plug-in, for the numbers of this precision. Component extension, installed only where it is asked for, and into the overlay.
include(PublicHeaders)

# A header is public if an extension includes it (first list), or if one of those does (second list). All others may change at any time.
set(plugin_headers
	contact/ContactForce.hpp # steps of a law
	contact/MarginContact.hpp # contacts of bodies with margins
	contact/MixedPairs.hpp # contacts with YADE's own shapes
	contact/PolytopeGeom.hpp # a contact
	contact/PolytopeGeomFunctor.hpp # what others derive from that make contacts
	host/FlatArchive.hpp # POLYTOPE_SAVED_FLAT
	material/JointLaws.hpp # normal laws of joints
	material/StiffnessRules.hpp # what a functor of physics tells
	shape/FamilyBound.hpp # boxes of shapes with a family
	shape/Polytope.hpp # the shape
	shape/ShapeFamily.hpp # what a shape of another base tells
	shape/WallShape.hpp # a wall as a half-space
	# which those include
	bond/BondsOfScene.hpp # members of the functor and of the contact
	contact/ContactCounters.hpp
	contact/StoredOutline.hpp
	contact/StoredVertices.hpp
	host/CheckedAttributes.hpp
	host/ChangeOfBodies.hpp
	host/FoundInStep.hpp
	host/InteractionLoops.hpp
	host/PeriodOfPair.hpp
	host/Seldom.hpp
	host/SpringsOfScene.hpp
	pairs/CandidateMemory.hpp
)
set(core_headers ${POLYTOPE_CORE_HEADERS} joint/BartonBandis.hpp joint/ContinuouslyYielding.hpp joint/JointTolerances.hpp shear/ContactOutline.hpp timestep/RockingStiffness.hpp timestep/StableTimeStep.hpp) # and what the plug-in's include

set(kit_include "${PROJECT_BINARY_DIR}/include/yade-polytope-${POLYTOPE_PRECISION}")
polytope_public_headers(polytope_kit_core SOURCE "${PROJECT_SOURCE_DIR}/src" PREFIX polytope INTO "${kit_include}" HEADERS ${core_headers})
configure_file("${PROJECT_BINARY_DIR}/generated/polytope/config.hpp" "${kit_include}/polytope/config.hpp" COPYONLY)
polytope_public_headers(
	polytope_kit
	SOURCE "${PROJECT_SOURCE_DIR}/pkg/polytope"
	PREFIX yade-polytope
	INTO "${kit_include}"
	HEADERS ${plugin_headers}
	CORE ${core_headers}
	AFTER polytope_kit_core
	FINGERPRINT "${kit_include}/yade-polytope/Fingerprint.hpp")

# YADE's headers, which no package of Debian has: installed beside ours for machines without YADE's sources
option(POLYTOPE_YADE_HEADERS "Install YADE's headers with what extensions are built with (component extension)" OFF)
set(kit_yade_sources "${YADE_SOURCE_DIR}")
if(POLYTOPE_YADE_HEADERS)
	set(kit_yade_sources "\${YADE_POLYTOPE_INCLUDE_DIR}/yade")
endif()

set(kit_cmake "${CMAKE_INSTALL_LIBDIR}/cmake/yade-polytope")
set(extension_dir "${YADE_LIBRARY_PATH}/yade-polytope/${POLYTOPE_PRECISION}") # beside YADE's library folder: Plugin.cpp
include(CMakePackageConfigHelpers)
set(kit_build "${PROJECT_BINARY_DIR}/cmake/${POLYTOPE_PRECISION}/build.cmake")
configure_file("${PROJECT_SOURCE_DIR}/cmake/extensionBuild.cmake.in" "${kit_build}" @ONLY)
configure_package_config_file(
	"${PROJECT_SOURCE_DIR}/cmake/yade-polytope-config.cmake.in" "${PROJECT_BINARY_DIR}/cmake/yade-polytope-config.cmake"
	INSTALL_DESTINATION "${kit_cmake}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cmake/yade-polytope-config-version.cmake" COMPATIBILITY SameMinorVersion)

install(
	CODE "file(REMOVE_RECURSE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/yade-polytope-${POLYTOPE_PRECISION}\")" COMPONENT extension
	EXCLUDE_FROM_ALL)
install(DIRECTORY "${kit_include}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT extension EXCLUDE_FROM_ALL)
install(FILES "${kit_build}" DESTINATION "${kit_cmake}/${POLYTOPE_PRECISION}" COMPONENT extension EXCLUDE_FROM_ALL)
set(modules Extension.cmake yadePolytopeExtension.cpp.in Eigen.cmake Yade.cmake YadeFeatures.cmake YadeHeaders.cmake YadeProgram.cmake yadeConfig.py)
list(TRANSFORM modules PREPEND "${PROJECT_SOURCE_DIR}/cmake/")
install(
	FILES ${modules} "${PROJECT_BINARY_DIR}/cmake/yade-polytope-config.cmake" "${PROJECT_BINARY_DIR}/cmake/yade-polytope-config-version.cmake"
	DESTINATION "${kit_cmake}"
	COMPONENT extension EXCLUDE_FROM_ALL)
if(POLYTOPE_YADE_HEADERS)
	set(kit_yade "${CMAKE_INSTALL_INCLUDEDIR}/yade-polytope-${POLYTOPE_PRECISION}/yade")
	install(FILES "${YADE_SOURCE_DIR}/RELEASE" DESTINATION "${kit_yade}" COMPONENT extension EXCLUDE_FROM_ALL)
	foreach(folder core lib pkg)
		install(DIRECTORY "${YADE_SOURCE_DIR}/${folder}" DESTINATION "${kit_yade}" COMPONENT extension EXCLUDE_FROM_ALL FILES_MATCHING REGEX "\\.(h|hpp|ipp|tpp)$")
	endforeach()
endif()
