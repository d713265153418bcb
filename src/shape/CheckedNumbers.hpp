// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <stdexcept>
#include <string>

/// What all files of shape construction ask of the numbers that a script gives, and how they refuse them.
namespace polytope {

/// \param message begins with the argument's name, ends with the remedy
[[noreturn]] inline void refuse(const std::string& message) { throw std::invalid_argument(message); }

inline bool finite(const Real& value) { return (Eigen::numext::isfinite)(value); }

/// A number, where abs() of a wider precision is an expression.
inline Real magnitude(const Real& value) { return value < 0 ? Real(-value) : value; }

} // namespace polytope
