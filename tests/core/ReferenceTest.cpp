// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every case of tests/reference/reference_cases.json (answers of an independent program, 30 digits), as given, with the
// bodies exchanged, and after rigid motions of the whole.
#include "PrecisePair.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <string>

using namespace polytope;
using namespace polytope::samples;

namespace {

using Json = nlohmann::json;

Real number(const Json& text) { return Real(std::stod(text.get<std::string>())); }

QuadVector quadVector(const Json& list)
{
	QuadVector v;
	for (int k = 0; k < 3; ++k)
		v[k] = Quad(list[k].get<std::string>());
	return v;
}

Vector3 vector(const Json& list) { return { number(list[0]), number(list[1]), number(list[2]) }; }

const Json& file()
{
	static const Json content = [] {
		std::ifstream in(POLYTOPE_REFERENCE_DIR "/reference_cases.json");
		return Json::parse(in);
	}();
	return content;
}

const Json& referenceCase(const std::string& name)
{
	for (const Json& entry : file()["cases"])
		if (entry["name"] == name) return entry;
	throw std::runtime_error("no reference case " + name);
}

std::vector<std::string> caseNames()
{
	std::vector<std::string> names;
	for (const Json& entry : file()["cases"])
		names.push_back(entry["name"]);
	return names;
}

Pair pairOf(const Json& entry)
{
	Pair        pair;
	const char* bodies[] = { "A", "B" };
	for (int body = 0; body < 2; ++body) {
		HalfSpaces set;
		for (const Json& plane : entry[bodies[body]]["planes"]) {
			set.normals.push_back(vector(plane));
			set.offsets.push_back(number(plane[3]));
		}
		pair.shape[body] = ConvexShape::shared(set, number(entry["r"]));
	}
	pair.centre2 = vector(entry["B"]["pos"]) - vector(entry["A"]["pos"]);
	return pair;
}

/// What the file says, moved with the pair: point from body 1's centre, normal from body 1 to body 2.
struct Expected {
	Real       s;
	bool       inContact, normalDefined, pointUnique;
	QuadVector centre, lpPoint, normal;
	Real       depth;

	explicit Expected(const Json& entry)
	{
		const Json& out   = entry["out"];
		s                 = number(out["lp_s"]);
		inContact         = out["intersects"];
		pointUnique       = out["lp_x_unique"];
		normalDefined     = inContact && !out["normal"].is_null();
		const auto origin = precise(vector(entry["A"]["pos"]));
		if (pointUnique) lpPoint = minus(quadVector(out["lp_x"]), origin);
		if (inContact) centre = minus(quadVector(out["ac"]), origin);
		if (!normalDefined) return;
		normal = quadVector(out["normal"]);
		depth  = number(out["penetration"]);
	}

	Expected swapped(const Vector3& centre2) const
	{
		Expected other = *this;
		other.centre   = minus(centre, precise(centre2));
		other.lpPoint  = minus(lpPoint, precise(centre2));
		for (Quad& component : other.normal)
			component = -component;
		return other;
	}

	Expected turned(const Matrix3& rotation) const
	{
		Expected other = *this;
		for (int k = 0; k < 3; ++k) {
			const QuadVector row = precise(rotation.row(k));
			other.centre[k]      = dot(row, centre);
			other.lpPoint[k]     = dot(row, lpPoint);
			other.normal[k]      = dot(row, normal);
		}
		return other;
	}
};

/// `size`: that of the bodies, 1e-13 of which is attainable for lengths. `roundings`: their number, of 1e-16 × size each, between the case as
/// the file has it and the contact frame.
void expectAnswer(const Pair& pair, const Expected& expected, Real size, const ContactResult& result, int roundings = 1)
{
	EXPECT_NEAR(result.infeasibility, expected.s, 1e-13 * size);
	ASSERT_EQ(result.inContact, expected.inContact) << statusName(result.status);
	if (!expected.inContact) {
		EXPECT_EQ(result.status, ContactStatus::Separated);
		return;
	}
	// a plane rounded by 1e-16 × size moves the centre by that part of the overlap's own size |s*|
	const PrecisePair exact(pair);
	const Real        loosened = 1e-9 + roundings * 1e-16 * size / std::abs(expected.s);
	EXPECT_LE(Real(exact.localLength(expected.centre, minus(precise(result.point), expected.centre))), loosened);
	EXPECT_NEAR(result.normal.norm(), 1, 1e-15);
	if (!expected.normalDefined) {
		EXPECT_EQ(result.status, ContactStatus::NormalFromDual);
		EXPECT_GT(result.depth, 0);
		return;
	}
	EXPECT_TRUE(result.status == ContactStatus::Contact || result.status == ContactStatus::RoundingLimited)
	        << statusName(result.status);
	const Real slip = Real(exact.normalSlip(0, expected.centre, loosened) + exact.normalSlip(1, expected.centre, loosened));
	EXPECT_LE(Real(norm(minus(precise(result.normal), expected.normal))), 1e-14 + slip);
	EXPECT_NEAR(result.depth, expected.depth, 1e-13 * size);
}

class Reference : public testing::TestWithParam<std::string> {
protected:
	const Json&    entry = referenceCase(GetParam());
	const Pair     pair  = pairOf(entry);
	const Expected expected { entry };
	const Real     size = pair.size();
};

TEST_P(Reference, AsGiven) { expectAnswer(pair, expected, size, query(pair)); }

TEST_P(Reference, BodiesExchanged) { expectAnswer(swapped(pair), expected.swapped(pair.centre2), size, query(swapped(pair))); }

TEST_P(Reference, WarmStarted)
{
	PairMemory memory;
	query(pair, ContactSettings(), &memory);
	const ContactResult result = query(pair, ContactSettings(), &memory);
	expectAnswer(pair, expected, size, result);
	EXPECT_EQ(result.simplexPivots, 0);
	if (result.inContact) {
		EXPECT_LE(result.newtonIterations, 3);
	}
}

TEST_P(Reference, MovedRigidly)
{
	std::mt19937_64 random(20120731);
	for (int motion = 0; motion < 50; ++motion) {
		SCOPED_TRACE("motion " + std::to_string(motion));
		const Matrix3 rotation = randomRotation(random);
		const Pair    moved    = turned(pair, rotation);
		// a turned plane: rounded rotation (not quite orthonormal), product of two rotations, centre, product with the plane,
		// each by the larger body's size
		const int roundings = 8;
		expectAnswer(moved, expected.turned(rotation), moved.reach(), query(moved), roundings);
		const Pair back = swapped(moved);
		expectAnswer(back, expected.swapped(pair.centre2).turned(rotation), moved.reach(), query(back), roundings);
	}
}

TEST_P(Reference, LpPoint)
{
	const ContactResult result = linearProgram(pair);
	// centre of a largest ball, whether or not there are several
	EXPECT_LE(Real(PrecisePair(pair).violation(precise(result.point))), expected.s + 1e-13 * size);
	if (!expected.pointUnique) return;
	// the basis' weights give how far the point moves when a plane does
	EXPECT_LE(Real(norm(minus(precise(result.point), expected.lpPoint))),
	        1e-13 * size / *std::min_element(result.weights.begin(), result.weights.end()));
}

INSTANTIATE_TEST_SUITE_P(Cases, Reference, testing::ValuesIn(caseNames()), [](const auto& info) {
	std::string name = info.param;
	for (char& c : name)
		if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
	return name;
});

TEST(ReferenceFile, HasAllCases) { EXPECT_EQ(caseNames().size(), 12u); }

} // namespace
