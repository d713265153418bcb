// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <sstream>
#include <stdexcept>
#include <tuple>

namespace yade {

/// Throws std::invalid_argument "name: must be rule, got value" where the attribute is not good.
template <class Value> void requireValue(bool good, const char* name, const Value& value, const char* rule)
{
	if (good) return;
	std::ostringstream message;
	message << name << ": must be " << rule << ", got " << value;
	throw std::invalid_argument(message.str());
}

/// Attributes of one object that are checked whenever one of them is set (postLoad): what is refused leaves all of them as they were.
template <class... Values> class CheckedAttributes {
public:
	using References = std::tuple<Values&...>;

	/// \param attributes with the values that they have by default
	explicit CheckedAttributes(const References& attributes) : good_(attributes) { }

	/// \param rules throws std::invalid_argument where the present values are not good
	template <class Rules> void check(References attributes, const Rules& rules)
	{
		try {
			rules();
		} catch (...) {
			attributes = good_;
			throw;
		}
		good_ = attributes;
	}

private:
	std::tuple<Values...> good_;
};

} // namespace yade
