// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

/// Defines `contact` in yade._polytope, and the class of what it returns (for PythonModule.cpp): the contact of two bodies as they are,
/// without a scene.
void definePairContact();

} // namespace yade
