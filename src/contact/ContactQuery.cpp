// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/ContactQuery.hpp"

#include "contact/ContactKernel.hpp"
#include "contact/LinearContact.hpp"
#include "contact/PairOrder.hpp"
#include "numbers/InstructionSet.hpp"

#include <algorithm>
#include <memory>
#include <new>

namespace polytope {

namespace {

	Real* atLeast(std::size_t needed, std::vector<Real>& numbers)
	{
		if (numbers.size() < needed) numbers.resize(needed);
		return numbers.data();
	}

} // namespace

Real* ContactWorkspace::rows(int rowCount, int length) { return atLeast(std::size_t(rowCount) * length, rows_); }

Real* ContactWorkspace::rowsOfSolids(int rowCount, int length) { return atLeast(std::size_t(rowCount) * length, rowsOfSolids_); }

Real* ContactWorkspace::polygons(int length) { return atLeast(std::size_t(length), polygons_); }

int* ContactWorkspace::indices(int length)
{
	if (indices_.size() < std::size_t(length)) indices_.resize(length);
	return indices_.data();
}

Real* ContactWorkspace::points(int count) { return atLeast(2 * std::size_t(count), points_); }

void ContactWorkspace::finishOutline(bool exchanged, ContactResult& result)
{
	const int count = result.outlineCount;
	if (corners_.size() < std::size_t(count)) corners_.resize(count);
	for (int k = 0; k < count; ++k)
		corners_[k] = Vector2(points_[2 * k], points_[2 * k + 1]);
	if (exchanged) {
		const Real              n[3] = { result.normal[0], result.normal[1], result.normal[2] }, other[3] = { -n[0], -n[1], -n[2] };
		const Rotation<Real, 3> to = axesAround<Real, 3>(n), from = axesAround<Real, 3>(other);
		for (int k = 0; k < count; ++k) {
			Real p[3];
			for (int m = 0; m < 3; ++m)
				p[m] = corners_[k][0] * from.m[0][m] + corners_[k][1] * from.m[1][m];
			corners_[k] = Vector2(dot<Real, 3>(to.m[0], p), dot<Real, 3>(to.m[1], p));
		}
		std::reverse(corners_.begin(), corners_.begin() + count);
	}
	result.outline = corners_.data();
}

namespace {

	using Kernel = void (*)(const PlacedPair&, const ContactSettings&, PairMemory&, ContactWorkspace&, ContactResult&);

	struct Kernels {
		Kernel      flat[2];  ///< 2-D; of models without and with a surface
		Kernel      solid[2]; ///< 3-D
		const char* name;
	};

	// once per instruction set (InstructionSet.hpp)
#if defined(__x86_64__) && POLYTOPE_REAL_IS_DOUBLE
#define POLYTOPE_KERNEL(NAME, TARGET, WIDTH)                                                                                               \
	template <int D, bool Surface>                                                                                                     \
	__attribute__((target(TARGET))) void NAME(const PlacedPair& in, const ContactSettings& settings, PairMemory& memory,               \
	        ContactWorkspace& workspace, ContactResult& out)                                                                           \
	{                                                                                                                                  \
		contactKernel<Real, D, WIDTH, Surface>(in, settings, memory, workspace, out);                                              \
	}
	// four lanes with AVX-512 too: bodies have few faces, and its 32 registers hold the Hessian's sums
	POLYTOPE_KERNEL(kernelV4, "arch=x86-64-v4", 4)
	POLYTOPE_KERNEL(kernelV3, "arch=x86-64-v3", 4)
	POLYTOPE_KERNEL(kernelV1, "arch=x86-64", 2)

	Kernels chooseKernels()
	{
		switch (instructionSetOfMachine()) {
			case InstructionSet::V4:
				return { { kernelV4<2, false>, kernelV4<2, true> }, { kernelV4<3, false>, kernelV4<3, true> }, "AVX-512" };
			case InstructionSet::V3:
				return { { kernelV3<2, false>, kernelV3<2, true> }, { kernelV3<3, false>, kernelV3<3, true> }, "AVX2" };
			default: return { { kernelV1<2, false>, kernelV1<2, true> }, { kernelV1<3, false>, kernelV1<3, true> }, "SSE2" };
		}
	}
#else
	template <int D, bool Surface>
	void kernelScalar(
	        const PlacedPair& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
	{
		contactKernel<Real, D, 1, Surface>(in, settings, memory, workspace, out);
	}
	Kernels chooseKernels()
	{
		return { { kernelScalar<2, false>, kernelScalar<2, true> }, { kernelScalar<3, false>, kernelScalar<3, true> }, "scalar" };
	}
#endif

	const Kernels kernels = chooseKernels();

	/// Whether both bodies have these planes: a body whose shape was exchanged must not be read beyond its own.
	bool fits(const std::array<int, 4>& basis, const PlacedPair& pair)
	{
		const int count[2] = { pair.shape[0]->planeCount(), pair.shape[1]->planeCount() },
		          least    = 2 * std::min(count[0], count[1]) - 1;
		int beyond         = 0; // negative where a code is, or where the body of fewer planes might not have that plane
		for (int code : basis)
			beyond |= code | int(unsigned(least) - unsigned(code));
		if (beyond >= 0) return true;
		for (int code : basis)
			if (code < 0 || planeOfCode(code) >= count[bodyOfCode(code)]) return false;
		return true;
	}

} // namespace

void contactQuery(
        const PlacedPair& pair, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& result)
{
	if (memory.hasBasis && !fits(memory.basis, pair)) memory.hasBasis = memory.hasPoint = false;
	const int    dimension = pair.shape[0]->dimension();
	const bool   surface   = hasSurface(settings.contactModel);
	const Kernel kernel    = (dimension == 2 ? kernels.flat : kernels.solid)[surface];
	// reset in place: constructing a temporary and assigning it takes as long as the dismissal of a pair
	std::destroy_at(&result);
	new (&result) ContactResult;
	if (settings.linear) settings.linear->known = false;
	if (surface && secondGoesFirst(pair)) {
		const Vector3&   centre2 = *pair.centre2;
		const Vector3    centre1 = -centre2;
		const PlacedPair other   = pair.exchanged(centre1);
		exchangeBodies(memory);
		if (settings.internal) {
			InternalPlanes  internal  = *settings.internal;
			ContactSettings exchanged = settings;
			exchangeBodies(internal);
			exchanged.internal = &internal;
			kernel(other, exchanged, memory, workspace, result);
		} else kernel(other, settings, memory, workspace, result);
		exchangeBodies(memory);
		exchangeBodies(result, centre2, dimension);
		for (int k = 0; settings.inside && result.inContact && k < dimension; ++k)
			(*settings.inside)[k] += centre2[k];
		if (settings.linear) settings.linear->begin(pair, true, result);
		if (result.outlineCount > 0) workspace.finishOutline(true, result);
		return;
	}
	kernel(pair, settings, memory, workspace, result);
	if (settings.linear) settings.linear->begin(pair, false, result);
	if (result.outlineCount > 0) workspace.finishOutline(false, result);
}

const char* instructionSet() { return kernels.name; }

} // namespace polytope
