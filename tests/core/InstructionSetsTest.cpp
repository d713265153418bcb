// SPDX-License-Identifier: GPL-2.0-or-later
//
// The kernel for each lane width and instruction set this machine has, whichever of them ContactQuery.cpp chooses.
// (vectors are passed within this file only: the ABI warning does not apply)
#pragma GCC diagnostic ignored "-Wpsabi"
#include "SameAnswer.hpp"
#include "contact/ContactKernel.hpp"
#include "contact/ContactQuery.hpp"
#include "contact/PairOrder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

using namespace polytope;
using namespace polytope::samples;

namespace {

using Kernel = void (*)(const PlacedPair&, const ContactSettings&, PairMemory&, ContactWorkspace&, ContactResult&);

template <int D, bool Surface>
void scalar(const PlacedPair& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	contactKernel<Real, D, 1, Surface>(in, settings, memory, workspace, out);
}

template <int D, bool Surface>
void twoLanes(const PlacedPair& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	contactKernel<Real, D, 2, Surface>(in, settings, memory, workspace, out);
}

ContactResult from(const Kernel kernel, const Pair& pair, const ContactSettings& settings)
{
	ContactWorkspace workspace;
	PairMemory       memory;
	ContactResult    result;
	const PlacedPair in = pair.placed();
	kernel(in, settings, memory, workspace, result);
	return result;
}

/// The foundation of the same pair as query() gives, from another kernel.
void expectSameFoundation(const Pair& pair, const Kernel kernel)
{
	ContactSettings settings;
	settings.contactModel      = ContactModel::Foundation;
	const ContactResult result = query(pair, settings), other = from(kernel, pair, settings);
	ASSERT_EQ(result.inContact, other.inContact);
	if (!result.inContact) return;
	const Real whole = result.depth * result.area, thickness = -result.infeasibility;
	const Real allowed = (1e-9 + 1e4 * tolerance::rounding * pair.size() / thickness) * whole;
	EXPECT_LE((whole * result.normal - other.depth * other.area * other.normal).norm(), allowed);
	// the volume has fewer digits where the overlap is a sliver; what is wrong in one lane is off by more
	EXPECT_NEAR(result.energy * result.area, other.energy * other.area, 1e-4 * result.energy * result.area + allowed * thickness);
}

/// Expects the same of a pair from another kernel as from query(). `kernels`: those of 2-D and 3-D for the models without a surface, then for those with one.
void expectSameFrom(const Kernel* kernels)
{
	std::mt19937_64 random(600);
	SameAnswers     answers;
	for (int dimension = 2; dimension <= 3; ++dimension) {
		const Shapes shapes   = randomShapes(60, random, dimension);
		int          contacts = 0;
		for (int trial = 0; trial < 1500 && !testing::Test::HasFailure(); ++trial) {
			const Pair          pair   = randomPair(shapes, random);
			const ContactResult result = query(pair), other = from(kernels[dimension - 2], pair, {});
			ASSERT_EQ(result.inContact, other.inContact);
			// the order of the bodies is the query's business, not the kernel's
			if (!secondGoesFirst(pair.placed())) expectSameFoundation(pair, kernels[dimension]);
			if (!result.inContact) continue;
			++contacts;
			const PrecisePair exact(pair);
			answers.expect(exact, Allowance(pair, exact, result), result, other);
		}
		EXPECT_GT(contacts, 1000);
	}
	answers.expectFew(0);
}

TEST(InstructionSets, ScalarsGiveTheSame)
{
	const Kernel kernels[] = { scalar<2, false>, scalar<3, false>, scalar<2, true>, scalar<3, true> };
	expectSameFrom(kernels);
}

#if defined(__x86_64__) && POLYTOPE_REAL_IS_DOUBLE

TEST(InstructionSets, TwoLanesGiveTheSame)
{
	const Kernel kernels[] = { twoLanes<2, false>, twoLanes<3, false>, twoLanes<2, true>, twoLanes<3, true> };
	expectSameFrom(kernels);
}

template <int D, bool Surface>
__attribute__((target("arch=x86-64-v3"))) void fourLanes(
        const PlacedPair& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	contactKernel<Real, D, 4, Surface>(in, settings, memory, workspace, out);
}

TEST(InstructionSets, FourLanesGiveTheSame)
{
	__builtin_cpu_init();
	if (!__builtin_cpu_supports("x86-64-v3")) GTEST_SKIP() << "no AVX2 here";
	const Kernel kernels[] = { fourLanes<2, false>, fourLanes<3, false>, fourLanes<2, true>, fourLanes<3, true> };
	expectSameFrom(kernels);
}

// POLYTOPE_INSTRUCTION_SET is for tests: what CMakeLists.txt runs with it must not be the machine's own again.
TEST(InstructionSets, IsTheOneAskedFor)
{
	const char*       asked = std::getenv("POLYTOPE_INSTRUCTION_SET");
	const std::string used  = instructionSet();
	if (!asked) {
		EXPECT_TRUE(used == "SSE2" || used == "AVX2" || used == "AVX-512") << used;
		return;
	}
	__builtin_cpu_init();
	if (asked == std::string("AVX2") && !__builtin_cpu_supports("x86-64-v3")) GTEST_SKIP() << "no AVX2 here";
	EXPECT_EQ(used, asked);
}

#endif

} // namespace
