// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <boost/python.hpp>

namespace yade {

/// Columns of all real interactions; \returns (columns, names of the statuses). In ContactArrays.cpp.
boost::python::tuple contactColumns();

/// Defines `bodyColumns` and `contactColumns` in yade._polytope (for PythonModule.cpp): what py/polytope/measures/arrays.py makes NumPy arrays of.
void defineArrays();

} // namespace yade
