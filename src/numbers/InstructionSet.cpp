// SPDX-License-Identifier: GPL-2.0-or-later
#include "numbers/InstructionSet.hpp"

#include "numbers/Real.hpp"

#include <cstdlib>
#include <string>

namespace polytope {

InstructionSet instructionSetOfMachine()
{
#if defined(__x86_64__) && POLYTOPE_REAL_IS_DOUBLE
	const char*       asked  = std::getenv("POLYTOPE_INSTRUCTION_SET");
	const std::string name   = asked ? asked : "";
	const bool        upToV3 = name == "AVX2", upToV1 = name == "SSE2";
	__builtin_cpu_init();
	if (__builtin_cpu_supports("x86-64-v4") && !upToV3 && !upToV1) return InstructionSet::V4;
	if (__builtin_cpu_supports("x86-64-v3") && !upToV1) return InstructionSet::V3;
#endif
	return InstructionSet::Baseline;
}

} // namespace polytope
