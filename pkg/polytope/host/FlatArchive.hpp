// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/serialization/Serializable.hpp>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/access.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/serialization.hpp>
#include <boost/serialization/tracking.hpp>

#include <array>

#include <type_traits>

namespace yade {

/// Values of which a binary archive need not know the class: for each of the others it looks it up, by name.
template <class Value> struct SavedInPlace : std::is_same<Value, Vector3r> { };
template <class Number, std::size_t size> struct SavedInPlace<std::array<Number, size>> : std::true_type { };

/// Writes and reads a class' attributes and those of its bases one after the other, as if it had no bases.
///
/// Boost's archives note the address of each object that they save, and of each base of it as an object of its own: six for one
/// RockJointPhys. At a hundred thousand bodies most of the time of O.save goes into looking those up.
template <class Archive> class FlatArchive {
public:
	using is_loading = typename Archive::is_loading;
	using is_saving  = typename Archive::is_saving;

	explicit FlatArchive(Archive& archive) : archive_(archive) { }

	template <class Value> FlatArchive& operator&(const boost::serialization::nvp<Value>& value)
	{
		if constexpr (std::is_base_of<Serializable, Value>::value) boost::serialization::access::serialize(*this, value.value(), 0);
		else if constexpr (isBinary && SavedInPlace<Value>::value) boost::serialization::serialize_adl(archive_, value.value(), 0);
		else archive_ & value;
		return *this;
	}

private:
	static constexpr bool isBinary = std::is_same<Archive, boost::archive::binary_oarchive>::value
	        || std::is_same<Archive, boost::archive::binary_iarchive>::value;

	Archive& archive_;
};

} // namespace yade

/// To be written after the class of those of our objects of which there are many.
#define POLYTOPE_SAVED_FLAT(Class)                                                                                                         \
	namespace boost::serialization {                                                                                                   \
		template <class Archive> void serialize(Archive& archive, yade::Class& object, const unsigned int version)                 \
		{                                                                                                                          \
			yade::FlatArchive<Archive> flat(archive);                                                                          \
			access::serialize(flat, object, version);                                                                          \
		}                                                                                                                          \
	}

/// POLYTOPE_SAVED_FLAT for a class whose objects belong to one other object each, by which they are found: the archive does not note them at all.
#define POLYTOPE_SAVED_FLAT_WITH_ITS_OWNER(Class)                                                                                          \
	BOOST_CLASS_TRACKING(yade::Class, boost::serialization::track_never)                                                               \
	POLYTOPE_SAVED_FLAT(Class)
