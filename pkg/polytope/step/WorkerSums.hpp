// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

/// Defines `stiffnessSums` and `takeStiffnessSums` in yade._polytope (for PythonModule.cpp).
void defineWorkerSums();

} // namespace yade
