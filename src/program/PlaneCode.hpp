// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A plane of one of the two bodies of a pair as one number, 2 × plane + body: how memories, results and saved contacts name planes. Rows
/// are those of PairPlanes, body 2's behind the `first` of body 1.
namespace polytope {

constexpr int planeCode(int body, int plane) { return 2 * plane + body; }
constexpr int bodyOfCode(int code) { return code & 1; }
constexpr int planeOfCode(int code) { return code >> 1; }
/// The code with the two bodies exchanged.
constexpr int exchangedCode(int code) { return code ^ 1; }

constexpr int rowOfCode(int code, int first) { return planeOfCode(code) + (bodyOfCode(code) ? first : 0); }
constexpr int codeOfRow(int row, int first) { return row >= first ? planeCode(1, row - first) : planeCode(0, row); }

} // namespace polytope
