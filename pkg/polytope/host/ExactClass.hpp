// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <typeinfo>

namespace yade {

/// The object as this class, null if it is of another one, derived ones included. A dynamic_cast takes ten times as long.
template <class Exact, class Object> const Exact* exactly(const Object* object)
{
	return object && typeid(*object) == typeid(Exact) ? static_cast<const Exact*>(object) : nullptr;
}

/// The object as this class or one derived from it, null if it is neither: a dynamic_cast that is quick for the class itself.
template <class Class, class Object> const Class* asClass(const Object* object)
{
	const Class* const exact = exactly<Class>(object);
	return exact ? exact : dynamic_cast<const Class*>(object);
}

} // namespace yade
