// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a program outside the core may call. All else is compiled with hidden visibility: inline functions of Eigen, compiled here with
/// YADE's options, are then not those of the program.
#define POLYTOPE_API __attribute__((visibility("default")))
