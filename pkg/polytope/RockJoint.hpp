// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/ElastMat.hpp>
#include <pkg/dem/FrictPhys.hpp>

namespace yade {

class RockJointMat : public FrictMat {
public:
	virtual ~RockJointMat() = default;
	void postLoad(RockJointMat&);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(RockJointMat, FrictMat, "Material of rock blocks.",
		((Real, normalStiffness, 1e9, Attr::triggerPostLoad, "Joint normal stiffness."))
		, createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(RockJointMat, FrictMat);
};
REGISTER_SERIALIZABLE(RockJointMat);

} // namespace yade
