// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/LinearContact.hpp"

/// The derivative of a contact from its neighbours, where it has none in closed form: where internal faces are left out, the part of the surface that lies on
/// a piece ends in lines which move through the pressure; and of polygons, whose queries take less.
namespace polytope {

/// Fills `linear`, or leaves it unknown where the contact is not smooth. Twelve queries, in the plane six, by a motion to either side: as far as the bodies may go until the
/// contact is computed in full again, so that the mean of the two shows what a derivative leaves out there.
///
/// \param settings of the query that gave `result`
/// \param memory   as that query has left it
POLYTOPE_API void linearByDifferences(const PlacedPair& pair, const ContactSettings& settings, const PairMemory& memory,
        ContactWorkspace& workspace, const ContactResult& result, LinearContact& linear);

} // namespace polytope
