// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Instruction sets for which some code is compiled, and chosen from when the library is loaded.
///
/// It is compiled so through function attributes, target(…), not per-file flags: inline functions of libraries that the linker merges across files stay
/// baseline code.
namespace polytope {

enum class InstructionSet {
	Baseline, ///< of any machine; the only one of arithmetics other than double, and of other processors than x86-64
	V3,       ///< x86-64-v3: AVX2
	V4        ///< x86-64-v4: AVX-512
};

/// The best that the machine has, and, where POLYTOPE_INSTRUCTION_SET in the environment names a lesser one (AVX2, SSE2), that: for tests of each.
InstructionSet instructionSetOfMachine();

} // namespace polytope
