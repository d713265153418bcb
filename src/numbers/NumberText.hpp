// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <sstream>
#include <string>

namespace polytope {

/// A number in a message, in the usual notation: 1e-9, not 1e-09; 1e50, not 1e+50.
inline std::string numberText(const Real& value)
{
	std::ostringstream stream;
	stream << value;
	std::string       text     = stream.str();
	const std::size_t exponent = text.find('e');
	if (exponent == std::string::npos) return text;
	std::size_t digit = exponent + 1;
	if (text[digit] == '+') text.erase(digit, 1);
	else ++digit;
	while (text[digit] == '0' && digit + 1 < text.size())
		text.erase(digit, 1);
	return text;
}

} // namespace polytope
