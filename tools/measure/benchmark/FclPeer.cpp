// SPDX-License-Identifier: GPL-2.0-or-later
#include "Peer.hpp"

#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <memory>
#include <vector>

/// FCL: fcl::collide with one contact asked for; its narrow phase is libccd's.
namespace {

class FclPeer : public peer::Peer {
public:
	const char* name() const override { return "FCL"; }
	int         add(const peer::Body& body) override
	{
		auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
		for (int i = 0; i < body.vertexCount; ++i)
			vertices->emplace_back(body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]);
		auto faces = std::make_shared<std::vector<int>>(body.faces, body.faces + body.faceLength);
		bodies_.push_back(std::make_unique<fcl::Convexd>(vertices, body.faceCount, faces));
		return int(bodies_.size()) - 1;
	}
	peer::Answer query(int body1, const peer::Pose& pose1, int body2, const peer::Pose& pose2) override
	{
		fcl::CollisionRequestd request(1, true);
		request.gjk_solver_type = fcl::GST_LIBCCD;
		fcl::CollisionResultd result;
		fcl::collide(bodies_[std::size_t(body1)].get(), transform(pose1), bodies_[std::size_t(body2)].get(), transform(pose2),
		        request, result);
		if (!result.isCollision()) return { false, false, 0, { 0, 0, 0 } };
		const auto& contact = result.getContact(0);
		return { true, true, contact.penetration_depth, { contact.normal[0], contact.normal[1], contact.normal[2] } };
	}

private:
	static fcl::Transform3d transform(const peer::Pose& pose)
	{
		fcl::Transform3d t = fcl::Transform3d::Identity();
		for (int i = 0; i < 3; ++i) {
			for (int j = 0; j < 3; ++j)
				t.linear()(i, j) = pose.rotation[3 * i + j];
			t.translation()[i] = pose.centre[i];
		}
		return t;
	}
	std::vector<std::unique_ptr<fcl::Convexd>> bodies_;
};

} // namespace

extern "C" peer::Peer* makeFcl() { return new FclPeer; }
