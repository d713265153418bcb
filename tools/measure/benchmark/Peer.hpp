// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A collision library to be measured beside us. Each sits in a shared library of its own, behind plain types: they are
/// compiled with flags of their own, and inline functions of Eigen must not be shared with ours.
namespace peer {

/// A convex body in its body frame: vertices (x, y, z each) and faces (corner count, then indices, counterclockwise from
/// outside), and planes (normal and offset, four numbers each).
struct Body {
	int           vertexCount;
	const double* vertices;
	int           faceCount, faceLength;
	const int*    faces;
	int           planeCount;
	const double* planes;
	double        radius; ///< circumradius
};

/// Body to world: row-major rotation, centre.
struct Pose {
	double rotation[9];
	double centre[3];
};

struct Answer {
	bool   touching;
	bool   hasDepth;
	double depth;        ///< moved by it along `direction`, body 2 is free
	double direction[3]; ///< unit, from body 1 to body 2
};

class Peer {
public:
	virtual ~Peer()                  = default;
	virtual const char* name() const = 0;
	/// The library's own form of a body, made once; the index is its number.
	virtual int    add(const Body& body)                                             = 0;
	virtual Answer query(int body1, const Pose& pose1, int body2, const Pose& pose2) = 0;
};

} // namespace peer
