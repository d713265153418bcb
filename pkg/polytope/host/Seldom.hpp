// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/FlatArchive.hpp"

#include <memory>

namespace yade {

/// A value that few of many objects have: the others hold 8 bytes in its place. A copy has a value of its own; archives have it by value.
template <class Value> class Seldom {
public:
	Seldom() = default;
	Seldom(const Seldom& other) : value_(other.value_ ? new Value(*other.value_) : nullptr) { }
	Seldom(Seldom&&) noexcept = default;
	Seldom& operator=(Seldom other) noexcept
	{
		value_ = std::move(other.value_);
		return *this;
	}
	~Seldom() = default;

	/// Null where there is none.
	const Value* get() const { return value_.get(); }
	Value*       get() { return value_.get(); }
	/// Made where there is none.
	Value& make()
	{
		if (!value_) value_.reset(new Value());
		return *value_;
	}
	void clear() { value_.reset(); }

private:
	std::unique_ptr<Value> value_;

	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		bool     there = bool(value_);
		archive& boost::serialization::make_nvp("there", there);
		if (!there) value_.reset();
		else archive& boost::serialization::make_nvp("value", make());
	}
};

template <class Value> struct SavedInPlace<Seldom<Value>> : std::true_type { };

} // namespace yade
