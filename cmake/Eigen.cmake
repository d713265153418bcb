# SPDX-License-Identifier: GPL-2.0-or-later
#
# Eigen, the same for the core and for YADE's headers. The version is compared here: asked for 3.4, Eigen 5 (the next release after 3.4) says that it
# is not compatible, and it is.
find_package(Eigen3 REQUIRED NO_MODULE)
if(Eigen3_VERSION VERSION_LESS 3.4)
	message(FATAL_ERROR "Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old: 3.4 or newer is needed (Debian: libeigen3-dev).")
endif()
