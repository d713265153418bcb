# SPDX-License-Identifier: GPL-2.0-or-later
#
# What holds for every file we compile. Use it through the target `polytope_options`.

# Release is what users and tests run. The level of optimisation is chosen per layer (see polytope_optimise).
if(NOT CMAKE_BUILD_TYPE AND PROJECT_IS_TOP_LEVEL)
	set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-DNDEBUG")

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(POLYTOPE_CCACHE ccache)
if(POLYTOPE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
	set(CMAKE_CXX_COMPILER_LAUNCHER "${POLYTOPE_CCACHE}")
endif()

add_library(polytope_options INTERFACE)
target_compile_options(polytope_options INTERFACE -Wall -Wextra)
# Warnings are errors with the compiler we develop with; what another one finds must not stop a user's build.
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^14\\.")
	# false warnings of g++ 14 where it inlines Eigen's expressions
	target_compile_options(polytope_options INTERFACE -Werror -Wno-error=maybe-uninitialized)
endif()

# Checked builds (`./run sanitize`, `./run fuzz`): the core and its tests under clang's sanitizers, assertions of Eigen and of
# the standard library on.
if(POLYTOPE_SANITIZE)
	if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
		message(FATAL_ERROR "POLYTOPE_SANITIZE=${POLYTOPE_SANITIZE} needs clang: -DCMAKE_CXX_COMPILER=clang++")
	endif()
	set(sanitize "-fsanitize=${POLYTOPE_SANITIZE}" "-fno-sanitize-recover=all" "-fno-omit-frame-pointer"
		"-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tools/measure/fuzz/ignored.txt")
	target_compile_options(polytope_options INTERFACE -O1 -g -UNDEBUG ${sanitize})
	target_compile_definitions(polytope_options INTERFACE CGAL_NDEBUG _GLIBCXX_ASSERTIONS)
	target_link_options(polytope_options INTERFACE ${sanitize})
	if(POLYTOPE_FUZZ)
		target_compile_options(polytope_options INTERFACE -fsanitize=fuzzer-no-link)
	endif()
endif()

# YADE is compiled with these. Types of Eigen are used in the interface between core and YADE, so all our files need the same, or
# the one-definition rule is broken. Loops that want SIMD work on plain arrays.
target_compile_definitions(polytope_options INTERFACE EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT)

# polytope_optimise(<target> <flags unless it is a debug build>…)
function(polytope_optimise target)
	if(POLYTOPE_SANITIZE)
		return() # with checks, optimisation takes long and gains nothing
	endif()
	foreach(flag IN LISTS ARGN)
		target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:${flag}>)
	endforeach()
endfunction()
