// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <boost/python/object.hpp>

#include <vector>

namespace yade {

/// Rows of numbers that a script gave, read and checked once (`_polytope.vectors`) and handed on to the functions of Construction.cpp as
/// they are: a list of Vector3 in between would take longer than making a body of a known shape.
struct Vectors {
	std::vector<Vector3r> rows; ///< rows of two components have z = 0
};

/// The numbers of a Python sequence of floats. YADE's own converter to std::vector keeps a reference to each item for ever: 32 bytes a number.
std::vector<Real> numbers(const boost::python::object& sequence);

/// Defines Vectors and `vectors` in yade._polytope (for PythonModule.cpp).
void defineVectors();

} // namespace yade
