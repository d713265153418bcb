# SPDX-License-Identifier: GPL-2.0-or-later
#
# The libraries whose headers YADE's headers include, according to the features; and polytope_use_yade(<target>).

# Boost.Python for this version of Python. The target that has the library's file is Boost::python where Boost has that one (1.83; the other only
# stands for it), else the one with the version in its name (1.92).
set(boost_python python${Python3_VERSION_MAJOR}${Python3_VERSION_MINOR})
find_package(Boost 1.74 REQUIRED CONFIG COMPONENTS ${boost_python} serialization iostreams log thread filesystem date_time regex)
if(TARGET Boost::python)
	set(boost_python python)
endif()
set(YADE_BOOST_PYTHON Boost::${boost_python})
set(yade_include_dirs "${YADE_SOURCE_DIR}")
set(yade_libraries
	Python3::Module Eigen3::Eigen ${YADE_BOOST_PYTHON} Boost::serialization Boost::iostreams Boost::log
	Boost::thread Boost::filesystem Boost::date_time Boost::regex)

if("OPENMP" IN_LIST YADE_FEATURES)
	find_package(OpenMP REQUIRED COMPONENTS CXX)
	list(APPEND yade_libraries OpenMP::OpenMP_CXX)
endif()
if("MPI" IN_LIST YADE_FEATURES)
	find_package(MPI REQUIRED COMPONENTS C CXX)
	list(APPEND yade_libraries MPI::MPI_CXX)
endif()
if("GTS" IN_LIST YADE_FEATURES)
	find_package(PkgConfig REQUIRED)
	pkg_check_modules(GTS REQUIRED IMPORTED_TARGET gts)
	list(APPEND yade_libraries PkgConfig::GTS)
endif()
if("VTK" IN_LIST YADE_FEATURES)
	find_package(VTK 9 REQUIRED COMPONENTS CommonCore CommonDataModel IOCore IOXML)
	list(APPEND yade_libraries VTK::CommonCore VTK::CommonDataModel VTK::IOCore VTK::IOXML)
endif()
if("QT5" IN_LIST YADE_FEATURES)
	find_package(Qt5 REQUIRED COMPONENTS Core Gui Widgets Xml OpenGL)
	find_package(OpenGL REQUIRED)
	find_path(QGLVIEWER_INCLUDE_DIR QGLViewer/qglviewer.h REQUIRED)
	find_library(GLUT_LIBRARY glut REQUIRED)
	list(APPEND yade_include_dirs "${QGLVIEWER_INCLUDE_DIR}")
	list(APPEND yade_libraries Qt5::Core Qt5::Gui Qt5::Widgets Qt5::Xml Qt5::OpenGL OpenGL::GL OpenGL::GLU "${GLUT_LIBRARY}")
endif()

# the quadruple precision of g++, part of the compiler
if(YADE_REAL_BIT EQUAL 128)
	list(APPEND yade_libraries quadmath)
endif()

# The libraries of YADE that have the classes we derive from, in an order in which they can be loaded.
set(YADE_PLUGIN_LIBRARIES libyade.so libpkg_common.so libpkg_dem.so)
foreach(library IN LISTS YADE_PLUGIN_LIBRARIES)
	list(APPEND yade_libraries "${YADE_LIBRARY_DIR}/${library}")
endforeach()

# YADE's Real, which polytope/config.hpp names, for a target without YADE's classes.
function(polytope_use_yade_real target)
	target_compile_definitions(${target} PUBLIC ${YADE_DEFINITIONS})
	target_include_directories(${target} SYSTEM PUBLIC "${YADE_SOURCE_DIR}")
	target_link_libraries(${target} PUBLIC Boost::headers Python3::Module $<$<EQUAL:${YADE_REAL_BIT},128>:quadmath>)
	# YADE's own; float128's literals are no standard C++
	set_target_properties(${target} PROPERTIES CXX_EXTENSIONS ON)
endfunction()

function(polytope_use_yade target)
	target_compile_definitions(${target} PRIVATE ${YADE_DEFINITIONS})
	target_compile_options(${target} PRIVATE ${YADE_OPTIONS})
	target_include_directories(${target} SYSTEM PRIVATE ${yade_include_dirs})
	target_link_libraries(${target} PRIVATE ${yade_libraries})
	# as YADE's own build: CMake's default
	set_target_properties(${target} PROPERTIES CXX_EXTENSIONS ON)
endfunction()
