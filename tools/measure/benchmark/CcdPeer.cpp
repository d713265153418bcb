// SPDX-License-Identifier: GPL-2.0-or-later
#include "Peer.hpp"

#include <ccd/ccd.h>

#include <cmath>
#include <vector>

/// libccd (Fiser): portal refinement. Its tolerances of 1e-4 are its defaults.
namespace {

struct Placed {
	const std::vector<double>* vertices;
	const peer::Pose*          pose;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out)
{
	const auto&   placed = *static_cast<const Placed*>(object);
	const double* r      = placed.pose->rotation;
	const double  x = direction->v[0], y = direction->v[1], z = direction->v[2];
	const double  own[3] = { r[0] * x + r[3] * y + r[6] * z, r[1] * x + r[4] * y + r[7] * z, r[2] * x + r[5] * y + r[8] * z };
	const double *v = placed.vertices->data(), *end = v + placed.vertices->size(), *best = v;
	double        most = -1e300;
	for (; v != end; v += 3) {
		const double along = v[0] * own[0] + v[1] * own[1] + v[2] * own[2];
		if (along > most) {
			most = along;
			best = v;
		}
	}
	for (int i = 0; i < 3; ++i)
		out->v[i] = r[3 * i] * best[0] + r[3 * i + 1] * best[1] + r[3 * i + 2] * best[2] + placed.pose->centre[i];
}

void centre(const void* object, ccd_vec3_t* out)
{
	for (int i = 0; i < 3; ++i)
		out->v[i] = static_cast<const Placed*>(object)->pose->centre[i];
}

class CcdPeer : public peer::Peer {
public:
	CcdPeer()
	{
		CCD_INIT(&settings_);
		settings_.support1 = settings_.support2 = support;
		settings_.center1 = settings_.center2 = centre;
		settings_.max_iterations              = 500;
	}
	const char* name() const override { return "libccd MPR"; }
	int         add(const peer::Body& body) override
	{
		bodies_.emplace_back(body.vertices, body.vertices + 3 * body.vertexCount);
		return int(bodies_.size()) - 1;
	}
	peer::Answer query(int body1, const peer::Pose& pose1, int body2, const peer::Pose& pose2) override
	{
		const Placed one { &bodies_[std::size_t(body1)], &pose1 }, two { &bodies_[std::size_t(body2)], &pose2 };
		ccd_vec3_t   direction, point;
		ccd_real_t   depth = 0;
		const int    code  = ccdMPRPenetration(&one, &two, &settings_, &depth, &direction, &point);
		return { code == 0, true, depth, { direction.v[0], direction.v[1], direction.v[2] } };
	}

private:
	ccd_t                            settings_;
	std::vector<std::vector<double>> bodies_;
};

} // namespace

extern "C" peer::Peer* makeCcd() { return new CcdPeer; }
