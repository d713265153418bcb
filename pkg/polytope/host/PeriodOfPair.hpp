// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

/// From where body 2 of a pair is to where it is in the period of body 1, so many cells away (Interaction::cellDist). In scenes that are not
/// periodic both functions return what they are given.
namespace yade {

/// A place of body 2 in the period of body 1; without a place the shift alone.
inline Vector3r placeByCells(const Scene& scene, const Vector3i& cells, const Vector3r& place = Vector3r::Zero())
{
	return scene.isPeriodic ? Vector3r(place + scene.cell->intrShiftPos(cells)) : place;
}

/// A velocity of body 2 there, as the cell deforms; without a velocity that of the shift alone.
inline Vector3r velocityByCells(const Scene& scene, const Vector3i& cells, const Vector3r& velocity = Vector3r::Zero())
{
	return scene.isPeriodic ? Vector3r(velocity + scene.cell->intrShiftVel(cells)) : velocity;
}

} // namespace yade
