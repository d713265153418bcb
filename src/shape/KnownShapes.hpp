// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <functional>
#include <iterator>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace polytope {

/// Shapes by the numbers they were made from, as long as they are in use: a table from lists of numbers to values whose `shape` is
/// a weak pointer. Entries no longer in use are removed when the table has doubled. Thread-safe.
template <class Value> class KnownShapes {
public:
	using Key = std::vector<Real>;

	/// False if there is none, or it is no longer in use; else `held` owns it.
	template <class Pointer> bool find(const Key& key, Value& value, Pointer& held)
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		const auto                        entry = known_.find(key);
		if (entry == known_.end()) return false;
		held  = entry->second.shape.lock();
		value = entry->second;
		return bool(held);
	}

	/// Puts a shape into the table and returns the one that is there: if two were made from the same numbers at the same time, the first stays.
	template <class Pointer> Pointer keep(Key key, const Value& value, const Pointer& held)
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		Value&                            entry = known_[std::move(key)];
		if (const Pointer other = entry.shape.lock()) return other;
		entry = value;
		sweep();
		return held;
	}

private:
	/// The numbers' roundings to double will do: equal numbers have equal ones.
	struct Hash {
		std::size_t operator()(const Key& key) const
		{
			std::size_t sum = key.size();
			for (const Real& number : key) // as boost::hash_combine
				sum ^= std::hash<double>()(double(number)) + 0x9e3779b97f4a7c15u + (sum << 6) + (sum >> 2);
			return sum;
		}
	};

	std::mutex                           mutex_;
	std::unordered_map<Key, Value, Hash> known_;
	std::size_t                          sweepAt_ = 64;

	void sweep()
	{
		if (known_.size() <= sweepAt_) return;
		for (auto entry = known_.begin(); entry != known_.end();)
			entry = entry->second.shape.expired() ? known_.erase(entry) : std::next(entry);
		sweepAt_ = known_.size() < 32 ? 64 : 2 * known_.size();
	}
};

} // namespace polytope
