// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <boost/python.hpp>

#include <cstdint>
#include <sys/mman.h>
#include <type_traits>

/// What the columns of bodies (Arrays.cpp) and of contacts (ContactArrays.cpp) are made of.
namespace yade::arrays {

/// Entries between the one that is written and the one whose memory is called into the cache: each of both steps (the interaction,
/// then what it refers to) has the time of as many entries.
constexpr std::size_t ahead = 16;

constexpr std::size_t largePage = std::size_t(1) << 21;

/// Asks for large pages in memory that will be written: a fault for each 4 kB costs as much as what is written there.
inline void wantLargePages(void* memory, std::size_t bytes)
{
	constexpr std::uintptr_t page  = 4096;
	const auto               begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
	const auto               end   = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
	if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE); // not to be had: small ones
}

/// Columns of one length, each the memory of a later NumPy array (a bytearray: no header of NumPy is needed to build).
class Table {
public:
	explicit Table(std::size_t rows) : rows_(rows) { }

	/// Memory of rows × `width` numbers of the type, which the dictionary owns. A large column begins with a large page, so that it
	/// has small ones nowhere: what lies before it and behind it is never touched, so it takes no memory.
	template <class Number> Number* column(const char* name, int width = 1)
	{
		const std::size_t           bytes  = rows_ * std::size_t(width) * sizeof(Number);
		const std::size_t           more   = bytes > largePage / 4 ? 2 * largePage : 0;
		PyObject* const             memory = PyByteArray_FromStringAndSize(nullptr, Py_ssize_t(bytes + more));
		const boost::python::object owner { boost::python::handle<>(memory) }; // throws if there is no memory
		char* const                 start  = PyByteArray_AS_STRING(memory);
		const std::size_t           beyond = reinterpret_cast<std::uintptr_t>(start) % largePage;
		const std::size_t           offset = more && beyond ? largePage - beyond : 0;
		if (more) wantLargePages(start + offset, (bytes + largePage - 1) / largePage * largePage);
		columns_[name] = boost::python::make_tuple(
		        owner, std::is_same<Number, double>::value ? "float64" : "int32", rows_ * std::size_t(width), offset, width);
		return reinterpret_cast<Number*>(start + offset);
	}

	boost::python::dict columns() const { return columns_; }

private:
	std::size_t         rows_;
	boost::python::dict columns_;
};

inline void put(double* column, std::size_t row, const Vector3r& vector)
{
	for (int k = 0; k < 3; ++k)
		column[3 * row + std::size_t(k)] = double(vector[k]);
}

} // namespace yade::arrays
