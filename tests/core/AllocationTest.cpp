// SPDX-License-Identifier: GPL-2.0-or-later
//
// The contact path allocates no memory once a thread has seen its largest pair. Operator new of the whole test program is
// replaced by one that counts.
#include "PairSamples.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

namespace {
thread_local long allocations = 0;

void* counted(std::size_t size)
{
	++allocations;
	if (void* memory = std::malloc(size ? size : 1)) return memory;
	throw std::bad_alloc();
}
} // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void  operator delete(void* memory) noexcept { std::free(memory); }
void  operator delete[](void* memory) noexcept { std::free(memory); }
void  operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void  operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using namespace polytope;
using namespace polytope::samples;

namespace {

TEST(Allocation, CounterCounts)
{
	const long before = allocations;
	delete new int(1);
	delete[] new double[3];
	EXPECT_GE(allocations, before + 2);
}

void expectNoneAfterTheLargest(ContactSettings settings, int dimension)
{
	std::mt19937_64   random(500);
	const Shapes      shapes = randomShapes(40, random, dimension, Real(-0.5));
	std::vector<Pair> pairs;
	for (int i = 0; i < 200; ++i)
		pairs.push_back(randomPair(shapes, random));
	std::vector<PairMemory> memories(pairs.size());
	ContactWorkspace        workspace;
	ContactResult           result;
	const auto              queryAll = [&] {
                int contacts = 0;
                for (std::size_t i = 0; i < pairs.size(); ++i) {
                        contactQuery(pairs[i].placed(), settings, memories[i], workspace, result);
                        contacts += result.hasGeometry;
                }
                return contacts;
	};
	EXPECT_GT(queryAll(), 100);
	const long before = allocations;
	for (int round = 0; round < 5; ++round) {
		if (round == 3) std::fill(memories.begin(), memories.end(), PairMemory());
		for (Pair& pair : pairs)
			pair.centre2 *= Real(0.999);
		queryAll();
	}
	EXPECT_EQ(allocations, before);
}

TEST(Allocation, NoneInTheContactPathAfterWarmUp)
{
	for (ContactPoint point : { ContactPoint::AnalyticCentre, ContactPoint::ChebyshevCentre, ContactPoint::Centroid })
		for (bool across : { false, true })
			for (int dimension = 2; dimension <= 3; ++dimension) {
				ContactSettings settings;
				settings.contactPoint = point;
				settings.section = settings.geometryAcrossGap = across;
				expectNoneAfterTheLargest(settings, dimension);
			}
}

TEST(Allocation, NoneInTheContactsOfASurfaceAfterWarmUp)
{
	for (const ContactModel model : { ContactModel::Foundation, ContactModel::Spring })
		for (int dimension = 2; dimension <= 3; ++dimension) {
			ContactSettings settings;
			settings.contactModel      = model;
			settings.geometryAcrossGap = true;
			expectNoneAfterTheLargest(settings, dimension);
		}
}

} // namespace
