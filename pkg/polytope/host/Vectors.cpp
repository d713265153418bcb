// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/Vectors.hpp"

#include <boost/python.hpp>

#include <stdexcept>
#include <string>

namespace py = boost::python;

namespace yade {
namespace {

	py::object borrowed(PyObject* object) { return py::object(py::handle<>(py::borrowed(object))); }

	/// A list or tuple as it is, of anything else that can be iterated a list.
	py::object itemsOf(const py::object& sequence) { return py::object(py::handle<>(PySequence_Fast(sequence.ptr(), "no sequence"))); }

	/// A float is taken as it is, anything else as `number` converts it (real() of precision.py).
	Real numberOf(PyObject* item, const py::object& number)
	{
		if (PyFloat_Check(item)) return Real(PyFloat_AS_DOUBLE(item));
		return py::extract<Real>(number(borrowed(item)));
	}

	/// One row; false if it has not `length` components.
	bool readRow(const py::object& row, int length, const py::object& number, Vector3r& vector)
	{
		if (!PyList_Check(row.ptr()) && !PyTuple_Check(row.ptr())) { // a Vector3 is slow to iterate: it ends by an exception
			const py::extract<const Vector3r&> whole(row);
			if (whole.check()) {
				vector = whole();
				return length == 3;
			}
		}
		const py::object items = itemsOf(row);
		Py_ssize_t       k     = 0;
		for (; k < PySequence_Fast_GET_SIZE(items.ptr()); ++k) { // `number` may run a script's code, which may change a list
			const Real component = numberOf(PySequence_Fast_GET_ITEM(items.ptr(), k), number);
			if (k < length) vector[k] = component;
		}
		return k == length;
	}

	/// \throws std::invalid_argument naming the argument: no sequence of rows of `length` numbers
	Vectors vectors(const py::object& rows, const std::string& name, int length, const py::object& number)
	{
		Vectors result;
		bool    complete = true;
		try {
			const py::object all = itemsOf(rows);
			for (Py_ssize_t i = 0; i < PySequence_Fast_GET_SIZE(all.ptr()); ++i) {
				Vector3r vector = Vector3r::Zero();
				complete &= readRow(borrowed(PySequence_Fast_GET_ITEM(all.ptr(), i)), length, number, vector);
				result.rows.push_back(vector);
			}
		} catch (const py::error_already_set&) {
			if (!PyErr_ExceptionMatches(PyExc_TypeError) && !PyErr_ExceptionMatches(PyExc_ValueError)) throw;
			PyErr_Clear();
			throw std::invalid_argument(name + ": must be a sequence of " + std::to_string(length) + "-vectors");
		}
		if (!complete) throw std::invalid_argument(name + ": every row must have " + std::to_string(length) + " components");
		return result;
	}

} // namespace

std::vector<Real> numbers(const py::object& sequence)
{
	const py::object  all = itemsOf(sequence);
	std::vector<Real> result;
	for (Py_ssize_t i = 0; i < PySequence_Fast_GET_SIZE(all.ptr()); ++i)
		result.push_back(py::extract<Real>(borrowed(PySequence_Fast_GET_ITEM(all.ptr(), i))));
	return result;
}

void defineVectors()
{
	py::class_<Vectors>("Vectors", "Rows of numbers, read and checked by vectors().", py::no_init)
	        .def("__len__", +[](const Vectors& v) { return v.rows.size(); });
	py::def("vectors", &vectors,
	        "Vectors of a sequence: rows, name of the argument, components of a row (2 or 3), function that converts what is no float. "
	        "ValueError naming the argument.");
}

} // namespace yade
