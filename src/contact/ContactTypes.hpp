// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/Status.hpp"
#include "joint/ClosureLaw.hpp"
#include "numbers/Tolerances.hpp"
#include "shape/HalfSpaces.hpp"
#include "surface/KeptVertices.hpp"

#include <array>
#include <limits>
#include <vector>

/// Input (ContactOptions, ContactSettings), memory from step to step (PairMemory), buffers (ContactWorkspace) and output (ContactResult) of a contact
/// query. Lengths in metres, world axes and from body 1's centre unless said otherwise; the normal points from body 1 to body 2.
namespace polytope {

enum class ContactPoint : int {
	AnalyticCentre = 0, ///< Eq. 10
	ChebyshevCentre,    ///< the LP's own point: centre of a largest ball in the overlap, lowest cost, jumps where it is not unique
	Centroid,           ///< of the overlap's volume (area in 2-D), highest cost
};

/// The solver for the analytic centre.
enum class CentreSolver : int {
	Newton = 0, ///< AnalyticCentre.hpp; where it does not converge, Ipopt if the build has it
	Ipopt,      ///< IpoptCentre.hpp for every contact: a hundred to a thousand times slower, independent of Newton
};

enum class ContactModel : int {
	Boon2012 = 0, ///< as printed: stiffness × chord along the averaged normal (Eqs 13-17) through the contact point
	Foundation,   ///< gradient of an energy, for a stiffness per area (SurfaceContact.hpp)
	Spring,       ///< gradient of an energy, for a stiffness per contact (SurfaceContact.hpp)
};

/// Whether the contact is that of a surface (SurfaceContact.hpp).
constexpr bool hasSurface(ContactModel model) { return model == ContactModel::Foundation || model == ContactModel::Spring; }

/// The solids that two bodies are pieces of: planes of each body that are internal faces, which neighbours cover where the other body passes, so that
/// nothing can touch them; and the planes of the solid that other pieces of it have near. The contact surface is that of the solids.
struct InternalPlanes {
	static constexpr int most = 32, mostEnds = 64;

	int   count[2] = { 0, 0 };
	int   plane[2][most];
	int   ends[2] = { 0, 0 };
	Plane end[2][mostEnds]; ///< in the body's axes and from its centre [m]
	/// No point of the overlap of the solids is farther from the body's centre [m], where it has internal planes.
	Real radius[2] = { std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity() };

	bool none() const { return count[0] + count[1] == 0; }
	void add(int body, int index) { plane[body][count[body]++] = index; }
	void addEnd(int body, const Plane& ofSolid) { end[body][ends[body]++] = ofSolid; }
};

struct ContactResult;
struct LinearContact;

/// What a user chooses, for all pairs of a scene alike.
struct ContactOptions {
	ContactModel contactModel = ContactModel::Boon2012;
	ContactPoint contactPoint = ContactPoint::AnalyticCentre; ///< of Boon2012
	CentreSolver solver       = CentreSolver::Newton;         ///< of Boon2012
	/// Contact when s* < −tolerance × the smaller body's circumradius.
	Real tolerance = tolerance::contact;
	/// Accepted remaining distance to the centre, in the overlap's own local norm (Newton; Ipopt goes to tolerance::ipoptMove).
	Real newtonTolerance = tolerance::newton;
	/// Start from the last query's basis and point, kept in PairMemory.
	bool warmStart = true;
	/// Foundation: also the energy, which takes half as long again; else it is −1.
	bool energy = true;
	/// Measure the LP's and the centre's time.
	bool timed = false;
};

/// What is asked about one pair, with these options.
struct ContactSettings : ContactOptions {
	/// Whether to compute also the contact section's area and centroid (length in 2-D).
	bool section = false;
	/// 3-D: also the outline of what the area is of.
	bool outline = false;
	/// Boon2012: weights of the two bodies' normals (Eq. 17), any non-negative pair with a positive sum.
	Real normalWeight[2] = { 1, 1 };
	/// End after the linear program: s*, and whether it is a contact, without point, normal and depth.
	bool programAlone = false;
	/// Give point, normal and (negative) depth also for a separated pair: a real interaction needs them until its law
	/// ends it.
	bool geometryAcrossGap = false;
	/// Models with a surface: the solids that the bodies are pieces of, or null.
	const InternalPlanes* internal = nullptr;
	/// Models with a surface: where the program's point of a touching pair is written to, which is inside the overlap, or null; world axes, from body 1's
	/// centre.
	Vector3* inside = nullptr;
	/// Models with a surface: the law of a joint that stiffens as it closes, or null.
	const ClosureLaw* closure = nullptr;
	/// 3-D, models with a surface: what gives the contact in the next steps (LinearContact.hpp), or null. Written where the surface has the vertices of
	/// the last step, else made unknown.
	LinearContact* linear = nullptr;

	ContactSettings() = default;
	explicit ContactSettings(const ContactOptions& options) : ContactOptions(options) { }
};

/// What one pair remembers from step to step. Values, no pointers: copied and saved with the interaction. Any value is safe, also of another pair, but
/// for the pieces of the surface (KeptVertices).
struct PairMemory {
	bool               hasBasis = false;         ///< `basis` is known, and, without a point, `weights`
	bool               hasPoint = false;         ///< `point` and `dualDirection` are known
	std::array<int, 4> basis { { 0, 0, 0, 0 } }; ///< codes of its planes (program/PlaneCode.hpp)
	/// LP dual λ of the basis' first planes (the last one's is the rest).
	Vector3                weights { Vector3::Zero() };
	std::array<Vector3, 2> point { Vector3::Zero(), Vector3::Zero() }; ///< last contact point in each body's frame
	/// Last n_λ, world axes.
	Vector3 dualDirection { Vector3::Zero() };
	/// What the models with a contact surface remember.
	KeptVertices surface;
};

struct ContactResult {
	ContactStatus status        = ContactStatus::Separated;
	bool          inContact     = false;
	bool          hasGeometry   = false;           ///< point, normal and depth are set
	Real          infeasibility = 0;               ///< s* [m]; for a pair dismissed early a lower bound > −tolerance
	Vector3       point         = Vector3::Zero(); ///< world axes, from body 1's centre
	Vector3       normal        = Vector3::Zero(); ///< unit, world axes, from body 1 to body 2
	Real          depth         = 0; ///< chord along the normal, positive in overlap; across a gap minus the way between the surfaces
	Vector3       dualDirection
	        = Vector3::Zero();   ///< n_λ = Σ over body 1 of λ_i a_i, world axes: moved apart by |s*|/|n_λ| along it the pair is free
	Real    area            = 0; ///< contact section (times thickness in 2-D)
	Vector3 sectionCentroid = Vector3::Zero(); ///< world axes, from body 1's centre
	/// If asked for: corners of the contact's outline, (u, v) along axesAround(normal) from the point, in the workspace until its next query; convex,
	/// counter-clockwise.
	const Vector2* outline      = nullptr;
	int            outlineCount = 0;
	Real energy = 0; ///< of the contact over its normal stiffness, at this depth [m²]; foundation: U over K A; spring: U over k
	Real share
	        = 1; ///< spring, with internal faces: part of the stiffness that this piece has, by the pressure on it; foundation: it is in the area
	Real turningArm    = 0; ///< foundation, spring: moment about the normal that a force at the point leaves out, over that force [m]
	bool dismissed     = false; ///< separated by the first basis' bound, without evaluating the other planes
	bool linear        = false; ///< foundation, spring: from the last full computation, to first order (LinearContact.hpp)
	bool surfaceKept   = false; ///< foundation, spring: the feasible set has the last step's vertices
	int  simplexPivots = 0;
	int  newtonIterations = 0;
	bool ipoptSolved      = false; ///< Ipopt was called, with or without success
	int  ipoptIterations  = 0;
	Real decrement        = 0;                      ///< Newton decrement before the last step
	long lpNanoseconds = 0, centreNanoseconds = 0;  ///< if asked for: frames and LP; centre
	std::array<int, 4>  basis { { 0, 0, 0, 0 } };   ///< as PairMemory::basis
	std::array<Real, 4> weights { { 0, 0, 0, 0 } }; ///< LP dual λ of the basis
};

/// Buffers of one thread; grow to the largest pair seen, and keep that size.
class POLYTOPE_API ContactWorkspace {
public:
	Real* rows(int rowCount, int length);
	/// For the planes of the solids that two bodies are pieces of.
	Real* rowsOfSolids(int rowCount, int length);
	Real* polygons(int length);
	int*  indices(int length);
	/// For the corners of the contact's outline.
	Real* points(int count);
	/// Makes it of them; `exchanged`: they were written for the opposite normal.
	void finishOutline(bool exchanged, ContactResult& result);

private:
	std::vector<Real>    rows_, rowsOfSolids_, polygons_, points_;
	std::vector<int>     indices_;
	std::vector<Vector2> corners_;
};

} // namespace polytope
