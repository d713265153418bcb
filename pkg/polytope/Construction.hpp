// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

/// Defines the functions of yade._polytope that make shapes, bodies and blocks of rock (for PythonModule.cpp).
void defineConstruction();

} // namespace yade
