// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Thresholds of joint laws, as numbers/Tolerances.hpp has those of the contact path: meaning, scale, reason.
namespace polytope::tolerance {

/// Closure from which on a closing joint keeps the stiffness that it has there, 10 000 times the initial one; as a part of the maximum
/// closure. Its pressure there is 99 times initial stiffness × maximum closure, more than rock bears; without an end a single step could
/// leave it beyond the pole.
constexpr double closureEnd = 0.99;

/// Steps of the search for the closure of a program's own law at a pressure: halving alone needs as many as the numbers have digits.
constexpr int mostClosureSteps = 200;

/// Whether a law's pressure, tangent and energy belong together is looked at from this closure on [m], a tenth of a micrometre, by so many
/// octaves, to 1.7 m: joints and contacts of what is built or falls close by micrometres to millimetres. Laws with another unit of length
/// have it there.
constexpr double leastClosure   = 1e-7;
constexpr int    closureOctaves = 24;

/// Closure that counts as none, as a part of leastClosure: below all roundings of closed forms.
constexpr double noClosure = 1e-20;

/// Relative difference of what grows to the integral of what it should be that is not called a fault: what a law that was written down
/// wrong is off by is more, and closed forms lose digits at small closures.
constexpr double closureAgreement = 1e-3;

/// Halvings of an octave by which its integrals are found: a bend or jump of the tangent is then within a 30 000th of it.
constexpr unsigned mostClosureHalvings = 15;

/// Closure below which the energy is computed by a series, as a part of the maximum closure: the closed form loses digits there with the
/// square of the closure. The terms of the series fall by this factor.
constexpr double smallClosure = 0.05;

/// Growth of a closing joint's stiffness from which on the time step is computed anew: with the default safety coefficient of 0.4 the step
/// is then still below 0.6 of what is stable.
constexpr double stiffening = 2;

/// Relative difference of a dilation and that of the same slip after it was turned with the contact: some roundings.
constexpr double sameDilation = 1e-12;

/// Largest friction angle of Barton's equation, dilation included [degrees]: Barton & Choubey (1977) advise not to go beyond 70°, where stresses are
/// so low that the logarithm has no meaning.
constexpr double steepestBarton = 70;

/// Largest τ/τₘ that a continuously-yielding joint remembers of where its motion turned back, as in UDEC: F would have no bound near 1.
constexpr double mostAtReversal = 0.75;

/// Least shear stiffness of a continuously-yielding joint, over that at the reference stress: one without any has no shear force that could be turned
/// into a displacement.
constexpr double softestShear = 0.01;

} // namespace polytope::tolerance
