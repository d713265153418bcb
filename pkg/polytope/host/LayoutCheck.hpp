// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks that YADE's classes have the same memory layout in our build as in the YADE binary.
///
/// A macro that differs between the two builds changes the layout of classes, which neither compiler nor linker notices;
/// the first contact then reads a wild pointer. So before any of our code touches one of YADE's objects:
///
///   - YADE's own class factory makes one object of each class, and the block of memory it lies in is compared with our
///     sizeof: reading all of our members then stays inside the block;
///   - the binary sets plain members by name (`pySetAttr`), from the first to the last, and we read them back through our
///     headers. Members of plain type alone: no pointer is followed.
///
/// If anything differs, an entry in the class factory makes `import yade` raise an ImportError that names it. The process
/// cannot continue then: our library's copies of inline functions may already be in use.
extern "C" void polytopeCheckLayout();
