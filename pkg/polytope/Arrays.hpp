// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

/// Defines `bodyColumns` and `contactColumns` in yade._polytope (for PythonModule.cpp): what py/polytope/arrays.py makes NumPy arrays of.
void defineArrays();

} // namespace yade
