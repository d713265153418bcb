// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "shape/ConvexShape.hpp"

/// One contact, start to end: both bodies' planes → LP → analytic centre → normal → depth (→ section). The only entry of
/// the plug-in into the numerical core. Nothing throws, prints or (after a thread's first pair of a size, Ipopt aside) allocates.
namespace polytope {

/// One pair. `rotation1`, `rotation2`: body to world; `centre2`: from body 1's centre to body 2's, world axes (so scene
/// coordinates never enter, and periodic shifts are the caller's). In 2-D the rotations are about z and z of everything
/// is ignored. What it needs of its arguments is not checked here: Preconditions.hpp does. Any value of the memory is safe: what does not fit the
/// pair is not used.
POLYTOPE_API void contactQuery(const ConvexShape& shape1, const Matrix3& rotation1, const ConvexShape& shape2, const Matrix3& rotation2,
        const Vector3& centre2, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& result);

/// Name of the instruction set the query runs with on this machine.
POLYTOPE_API const char* instructionSet();

} // namespace polytope
