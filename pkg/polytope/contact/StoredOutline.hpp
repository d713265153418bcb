// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <src/shear/ContactOutline.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace yade {

/// Corners of a contact's outline (src/shear/ContactOutline.hpp), kept from its geometry functor to its law. Made anew in each step: not saved.
class StoredOutline {
public:
	StoredOutline() = default;
	StoredOutline(const StoredOutline& other) { set(other.corners(), other.count()); }
	StoredOutline& operator=(const StoredOutline& other)
	{
		if (this != &other) set(other.corners(), other.count());
		return *this;
	}

	int                      count() const { return count_; }
	const polytope::Vector2* corners() const { return corners_.get(); }

	/// Needs new memory only where there are more corners than ever before.
	void set(const polytope::Vector2* corners, int count)
	{
		if (count > room_) {
			corners_.reset(new polytope::Vector2[std::size_t(count)]);
			room_ = count;
		}
		std::copy(corners, corners + count, corners_.get());
		count_ = count;
	}

private:
	std::unique_ptr<polytope::Vector2[]> corners_;
	std::int32_t                         count_ = 0, room_ = 0;
};

} // namespace yade
