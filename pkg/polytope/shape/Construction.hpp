// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

/// Defines the functions of yade._polytope that make shapes and bodies (for PythonModule.cpp).
void defineConstruction();

/// Defines those that cut rock into blocks.
void defineJointedRock();

} // namespace yade
