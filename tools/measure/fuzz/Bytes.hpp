// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

/// Decodes a fuzzer's bytes into numbers and planes, and checks conditions that must hold. Beyond the end of the bytes, all is zero.
namespace polytope::fuzz {

/// Ends the process by a trap: libraries that come along with Ipopt (MPI) take other signals from the fuzzer.
#define POLYTOPE_REQUIRE(CONDITION, ...)                                                                                                   \
	do {                                                                                                                               \
		if (!(CONDITION)) {                                                                                                        \
			std::fprintf(stderr, "\nviolated: %s (%s:%d): ", #CONDITION, __FILE__, __LINE__);                                  \
			std::fprintf(stderr, __VA_ARGS__);                                                                                 \
			std::fprintf(stderr, "\n");                                                                                        \
			__builtin_trap();                                                                                                  \
		}                                                                                                                          \
	} while (false)

class Bytes {
public:
	Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) { }

	bool empty() const { return next_ == end_; }

	std::uint8_t byte() { return empty() ? 0 : *next_++; }
	bool         flag() { return byte() & 1; }

	/// One of 0 … count − 1.
	int below(int count) { return byte() % count; }

	/// Ordinary numbers, and every kind of extreme one; often one that was used before, or its neighbour.
	Real number()
	{
		const int kind = byte();
		Real      value;
		if (kind < 96) value = Real(word()) / 4096; // −8 … 8
		else if (kind < 128) value = Real(std::int8_t(byte()));
		else if (kind < 160) value = special(byte());
		else if (kind < 176) value = raw();
		else if (kind < 192) value = std::ldexp(Real(1) + Real(byte()) / 256, word() % 1100) * (kind % 2 ? 1 : -1);
		else if (numbers_.empty()) value = 0;
		else {
			value = numbers_[byte() % numbers_.size()];
			if (kind >= 240) value = -value;
			else if (kind >= 216)
				for (int k = byte() % 8; k >= 0; --k)
					value = std::nextafter(value, kind % 2 ? std::numeric_limits<Real>::infinity() : Real(0));
		}
		numbers_.push_back(value);
		return value;
	}

	Vector3 vector()
	{
		const Real x = number(), y = number(), z = number();
		return Vector3(x, y, z);
	}

	std::int16_t word()
	{
		const int low = byte();
		return std::int16_t(low | byte() << 8);
	}

private:
	Real raw()
	{
		double       value = 0;
		std::uint8_t bits[sizeof value];
		for (std::uint8_t& b : bits)
			b = byte();
		std::memcpy(&value, bits, sizeof value);
		return Real(value);
	}

	static Real special(int index)
	{
		using Limits            = std::numeric_limits<double>;
		static const Real all[] = { 0, -0.0, 1, -1, Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
			Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), Limits::max(), Limits::lowest(), Limits::epsilon(),
			1 - Limits::epsilon() / 2, 1 + Limits::epsilon(), 1e-9, 1e-12, 1e-15, 1e9, 1e15, 1e60, 1e-60, 1e100, 1e-100, 1e154,
			1e-154, 1e300, 1e-300, 0.57735026918962573, 0.70710678118654757, 0.1, 3 };
		return all[std::size_t(index) % (sizeof all / sizeof *all)];
	}

	const std::uint8_t* next_;
	const std::uint8_t* end_;
	std::vector<Real>   numbers_;
};

/// Planes as they come: raw, along the axes, opposite or next to earlier ones. Begins with a box, a simplex or nothing, so
/// that many sets are bounded.
inline HalfSpaces planes(Bytes& bytes, int dimension)
{
	HalfSpaces set;
	set.dimension  = dimension;
	const auto add = [&](const Vector3& normal, const Real& offset) {
		set.normals.push_back(normal);
		set.offsets.push_back(offset);
	};
	const int axes  = dimension == 2 ? 2 : 3;
	const int begin = bytes.below(4);
	if (begin == 1)
		for (int k = 0; k < axes; ++k)
			for (int side = -1; side <= 1; side += 2)
				add(side * Vector3::Unit(k), bytes.number());
	else if (begin == 2) {
		for (int k = 0; k < axes; ++k)
			add(-Vector3::Unit(k), bytes.number());
		add(Vector3(1, 1, axes == 3), bytes.number());
	}
	for (int more = bytes.below(32); more > 0 && !bytes.empty(); --more) {
		const int style = bytes.below(4);
		Vector3   normal;
		if (style == 0 || set.normals.empty()) normal = bytes.vector();
		else {
			const Vector3& earlier = set.normals[bytes.byte() % set.size()];
			normal                 = style == 1 ? -earlier : earlier;
			if (style == 3) normal[bytes.below(axes)] += bytes.number();
		}
		if (dimension == 2 && style != 0) normal.z() = 0;
		add(normal, bytes.number());
	}
	return set;
}

} // namespace polytope::fuzz
