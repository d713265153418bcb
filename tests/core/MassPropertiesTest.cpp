// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/MassProperties.hpp"

#include "ShapeSamples.hpp"

using namespace polytope;
using namespace polytope::samples;

namespace {

const Real golden = (1 + std::sqrt(Real(5))) / 2;

/// Textbook values for edge length 1: volume, moment of inertia per mass, circumradius.
struct Solid {
	int  faces;
	Real volume, moment, circumradius;
};
const Solid solids[] = {
	{ 4, 1 / (6 * std::sqrt(Real(2))), Real(1) / 20, std::sqrt(Real(6)) / 4 },
	{ 6, 1, Real(1) / 6, std::sqrt(Real(3)) / 2 },
	{ 8, std::sqrt(Real(2)) / 3, Real(1) / 10, std::sqrt(Real(2)) / 2 },
	{ 12, (15 + 7 * std::sqrt(Real(5))) / 4, (39 * golden + 28) / 150, golden* std::sqrt(Real(3)) / 2 },
	{ 20, 5 * (3 + std::sqrt(Real(5))) / 12, golden* golden / 10, std::sqrt(golden* std::sqrt(Real(5))) / 2 },
};

TEST(MassProperties, regularSolidsAgreeWithTheTextbook)
{
	std::mt19937_64 random(41);
	for (const Solid& solid : solids)
		for (Real edge : lengths)
			for (int turn = 0; turn < 5; ++turn) {
				HalfSpaces set = regularSolid(solid.faces, solid.circumradius * edge);
				if (turn > 0) set = moved(set, someRotation(random), Vector3::Zero());
				const MassProperties mass   = massProperties(polyhedron(set));
				const Real           volume = solid.volume * edge * edge * edge;
				const Matrix3        unit   = mass.inertia / (solid.moment * edge * edge * volume);
				EXPECT_NEAR(mass.volume / volume, 1, 1e-13) << solid.faces;
				EXPECT_LT((unit - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-13) << solid.faces << " edge " << edge;
				EXPECT_LT(mass.centroid.norm(), 1e-14 * edge);
				const PrincipalAxes axes = principalAxes(mass.inertia);
				EXPECT_EQ(axes.rotation,
				        Matrix3(Matrix3::Identity())); // equal moments in any orientation: any axes are principal
			}
}

TEST(MassProperties, boxesInAnyOrientationAndPlace)
{
	std::mt19937_64 random(42);
	for (Real length : lengths)
		for (int turn = 0; turn < 20; ++turn) {
			const Vector3 half        = length * Vector3(1, 2, 3);
			const Matrix3 rotation    = someRotation(random);
			const Vector3 translation = 5 * length * someDirection(random);
			const auto    mass    = massProperties(polyhedron(moved(box(half.x(), half.y(), half.z()), rotation, translation)));
			const Real    volume  = 8 * half.prod();
			const Vector3 squares = half.cwiseAbs2();
			const Vector3 moments
			        = volume / 3 * Vector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
			const Matrix3 expected = rotation * moments.asDiagonal() * rotation.transpose();
			EXPECT_NEAR(mass.volume / volume, 1, 1e-13);
			EXPECT_LT((mass.centroid - translation).norm(), 1e-14 * 6 * length);
			EXPECT_LT((mass.inertia - expected).cwiseAbs().maxCoeff(), 1e-13 * moments.maxCoeff());
			EXPECT_EQ(mass.inertia, Matrix3(mass.inertia.transpose()));
		}
}

TEST(MassProperties, thinBoxesKeepTheDigitsTheirVerticesHave)
{
	std::mt19937_64 random(48);
	for (Real length : lengths)
		for (const Vector3& thin : { Vector3(1, 1, 1e-8), Vector3(1e-8, 1e-8, 1), Vector3(1, 1e-4, 1e-8) })
			for (int turn = 0; turn < 10; ++turn) {
				const Vector3 half     = length * thin;
				const Matrix3 rotation = turn == 0 ? Matrix3(Matrix3::Identity()) : someRotation(random);
				const auto    mass
				        = massProperties(polyhedron(moved(box(half.x(), half.y(), half.z()), rotation, Vector3::Zero())));
				const Vector3 squares = half.cwiseAbs2();
				const Real    volume  = 8 * half.prod();
				const Vector3 moments = volume / 3
				        * Vector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
				// corners of a turned box are rounded by 1e-16 of its length, 1e-8 of its thickness
				EXPECT_NEAR(mass.volume / volume, 1, turn == 0 ? 1e-14 : 3e-7);
				if (turn == 0) {
					EXPECT_LT((mass.inertia.diagonal().cwiseQuotient(moments) - Vector3::Ones()).cwiseAbs().maxCoeff(),
					        1e-14);
				} else {
					EXPECT_LT((rotation.transpose() * mass.inertia * rotation - Matrix3(moments.asDiagonal())).norm(),
					        1e-6 * moments.norm());
				}
			}
}

TEST(MassProperties, farFromTheOriginOnlyTheInputsDigitsAreLost)
{
	// coordinates that are exact in binary: no rounding at all
	const Vector3 place(1 << 20, -(1 << 21), 1 << 19);
	const Real    half = std::ldexp(Real(1), -11);
	const auto    near = massProperties(polyhedron(box(half, half, half)));
	const auto    far  = massProperties(polyhedron(moved(box(half, half, half), Matrix3::Identity(), place)));
	EXPECT_EQ(far.volume, near.volume);
	EXPECT_EQ(far.centroid, place);
	EXPECT_LT((far.inertia - near.inertia).cwiseAbs().maxCoeff(), 1e-15 * near.inertia.trace());
	// and coordinates that are not: rounded to 1e-10 of 1e-3
	const auto rounded = massProperties(polyhedron(moved(box(5e-4, 5e-4, 5e-4), Matrix3::Identity(), Vector3(1e6, 1e6, 1e6))));
	EXPECT_NEAR(rounded.volume / 1e-9, 1, 1e-6);
	EXPECT_NEAR(rounded.inertia(0, 0) / (1e-15 / 6), 1, 1e-6);
}

TEST(MassProperties, prismsInTwoDimensions)
{
	for (Real length : lengths)
		for (Real thickness : { 1e-3, 1., 1e2 })
			for (int sides : { 3, 4, 6, 31 }) {
				const Real inradius = length, angle = Real(M_PI) / sides;
				const auto mass = massProperties(
				        polyhedron(moved(regularPolygon(sides, inradius), Matrix3::Identity(), Vector3(length, -length, 0)),
				                thickness));
				const Real area   = sides * inradius * inradius * std::tan(angle);
				const Real volume = area * thickness;
				// polar second moment of a regular polygon per area: r²/2 (1 + tan²(π/n)/3), half of it about each axis
				const Real polar = inradius * inradius / 2 * (1 + std::tan(angle) * std::tan(angle) / 3);
				EXPECT_NEAR(mass.volume / volume, 1, 1e-13);
				EXPECT_LT((mass.centroid - Vector3(length, -length, 0)).head<2>().norm(), 1e-14 * length);
				EXPECT_NEAR(mass.centroid.z(), 0, 1e-15 * thickness);
				EXPECT_NEAR(mass.inertia(2, 2) / (volume * polar), 1, 1e-13);
				EXPECT_NEAR(mass.inertia(0, 0) / (volume * (polar / 2 + thickness * thickness / 12)), 1, 1e-13);
				EXPECT_NEAR(mass.inertia(1, 1) / (volume * (polar / 2 + thickness * thickness / 12)), 1, 1e-13);
				EXPECT_EQ(principalAxes(mass.inertia, 2).rotation, Matrix3(Matrix3::Identity()));
			}
}

TEST(MassProperties, randomPolytopesAgreeWithAnotherApex)
{
	std::mt19937_64 random(43);
	for (int i = 0; i < 30; ++i) {
		const Polyhedron shape = polyhedron(tangentPlanes(80, Vector3(1, 2, 3), random));
		const auto       mass  = massProperties(shape);
		EXPECT_NEAR(mass.volume / volumeFromVertex(shape, std::size_t(i)), 1, 1e-13);
		// the ellipsoid it is tangent to lies inside and nearly fills it
		EXPECT_GT(mass.volume, 4 * M_PI / 3 * 6);
		EXPECT_LT(mass.volume, 4 * M_PI / 3 * 6 * 1.5);
	}
}

TEST(MassProperties, shapesWithoutVolumeAreRefused)
{
	EXPECT_TRUE(says(refusal([] { massProperties(Polyhedron()); }), "shape: it has no vertices"));
	Polyhedron insideOut = polyhedron(box(1, 1, 1));
	for (auto& face : insideOut.faces)
		std::swap(face[0], face[2]);
	EXPECT_TRUE(says(refusal([&] { massProperties(insideOut); }), "shape: its volume is not positive"));
}

// ---- principal axes ---------------------------------------------------------------------------------------------------

void expectPrincipal(const PrincipalAxes& axes, const Matrix3& inertia)
{
	const Real scale = inertia.cwiseAbs().maxCoeff();
	EXPECT_NEAR(axes.rotation.determinant(), 1, 1e-14);
	EXPECT_LT((axes.rotation.transpose() * axes.rotation - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-14);
	EXPECT_LT((axes.rotation * axes.moments.asDiagonal() * axes.rotation.transpose() - inertia).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

TEST(PrincipalAxes, randomTensorsAtEverySize)
{
	std::mt19937_64                        random(44);
	std::uniform_real_distribution<double> moment(1, 2);
	for (Real scale : { 1e-45, 1e-15, 1., 1e20 })
		for (int i = 0; i < 50; ++i) {
			const Matrix3 rotation = someRotation(random);
			const Vector3 moments  = scale * Vector3(moment(random), moment(random), moment(random));
			const Matrix3 inertia  = rotation * moments.asDiagonal() * rotation.transpose();
			const auto    axes     = principalAxes(inertia);
			expectPrincipal(axes, inertia);
			EXPECT_LE(axes.moments[0], axes.moments[1]);
			EXPECT_LE(axes.moments[1], axes.moments[2]);
			EXPECT_EQ(principalAxes(inertia).rotation, axes.rotation);
		}
}

TEST(PrincipalAxes, aDiagonalTensorKeepsItsAxesAndOrder)
{
	Matrix3 inertia = Vector3(3, 1, 2).asDiagonal();
	inertia(0, 1) = inertia(1, 0) = 1e-14; // rounding
	const auto axes               = principalAxes(inertia);
	EXPECT_EQ(axes.rotation, Matrix3(Matrix3::Identity()));
	EXPECT_EQ(axes.moments, Vector3(3, 1, 2));
	inertia(0, 1) = inertia(1, 0) = 1e-10; // not rounding
	const auto turned             = principalAxes(inertia);
	expectPrincipal(turned, inertia);
	EXPECT_NEAR(turned.moments[0], 1, 1e-9);
	EXPECT_NEAR(std::abs(turned.rotation(1, 0)), 1, 1e-9);
	EXPECT_EQ(principalAxes(Matrix3::Zero()).rotation, Matrix3(Matrix3::Identity()));
}

TEST(PrincipalAxes, twoEqualMoments)
{
	std::mt19937_64 random(45);
	for (const Vector3& moments : { Vector3(1, 1, 2), Vector3(1, 2, 2), Vector3(1, 1 + 1e-15, 2) })
		for (int i = 0; i < 20; ++i) {
			const Matrix3 rotation = someRotation(random);
			const Matrix3 inertia  = rotation * moments.asDiagonal() * rotation.transpose();
			expectPrincipal(principalAxes(inertia), inertia);
		}
}

TEST(PrincipalAxes, inTwoDimensionsTheThirdAxisStaysZ)
{
	std::mt19937_64 random(46);
	for (int i = 0; i < 50; ++i) {
		const Matrix3 turn    = Eigen::AngleAxis<Real>(Real(0.1) + i, Vector3::UnitZ()).toRotationMatrix();
		const Matrix3 inertia = turn * Vector3(2, 1, Real(0.5)).asDiagonal() * turn.transpose();
		const auto    axes    = principalAxes(inertia, 2);
		expectPrincipal(axes, inertia);
		EXPECT_EQ(axes.rotation.col(2), Vector3(Vector3::UnitZ()));
		EXPECT_EQ(axes.rotation.row(2).transpose(), Vector3(Vector3::UnitZ()));
		EXPECT_NEAR(axes.moments[0], 1, 1e-14);
		EXPECT_NEAR(axes.moments[1], 2, 1e-14);
		EXPECT_EQ(axes.moments[2], inertia(2, 2));
	}
}

TEST(PrincipalAxes, aBoxTurnedToThemIsAligned)
{
	std::mt19937_64 random(47);
	for (int i = 0; i < 20; ++i) {
		const HalfSpaces set  = moved(box(1, 2, 3), someRotation(random), someDirection(random));
		const auto       axes = principalAxes(massProperties(polyhedron(set)).inertia);
		const HalfSpaces body = moved(set, axes.rotation.transpose(), Vector3::Zero());
		for (const Vector3& normal : body.normals)
			EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1, 1e-12);
	}
}

} // namespace
