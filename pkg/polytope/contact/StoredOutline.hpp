// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <src/contact/LinearContact.hpp>
#include <src/shear/ContactOutline.hpp>

#include "host/FlatArchive.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace yade {

/// Corners of a contact's outline (src/shear/ContactOutline.hpp), kept from its geometry functor to its law. Saved where the next step's is this one moved.
class StoredOutline {
public:
	StoredOutline() = default;
	StoredOutline(const StoredOutline& other) { *this = other; }
	StoredOutline& operator=(const StoredOutline& other)
	{
		if (this == &other) return *this;
		set(other.corners(), other.count());
		isKept_ = other.isKept_;
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
		count_  = count;
		isKept_ = false;
	}

	/// The next step takes it along instead of making it anew.
	void keep() { isKept_ = true; }
	void move(const polytope::OutlineMotion& motion)
	{
		for (int k = 0; k < count_; ++k)
			corners_[std::size_t(k)] = motion.moved(corners_[std::size_t(k)]);
	}

private:
	std::unique_ptr<polytope::Vector2[]> corners_;
	std::int32_t                         count_ = 0, room_ = 0;
	bool                                 isKept_ = false;

	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		int      count = isKept_ ? count_ : 0;
		archive& boost::serialization::make_nvp("count", count);
		if (Archive::is_loading::value) {
			set(nullptr, 0);
			room_ = count_ = math::max(count, 0);
			corners_.reset(new polytope::Vector2[std::size_t(count_)]);
			isKept_ = count > 0;
		}
		for (int k = 0; k < count; ++k)
			for (int m = 0; m < 2; ++m)
				archive& boost::serialization::make_nvp("corner", corners_[std::size_t(k)][m]);
	}
};

template <> struct SavedInPlace<StoredOutline> : std::true_type { };

} // namespace yade
