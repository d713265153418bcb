// SPDX-License-Identifier: GPL-2.0-or-later
#include "Peer.hpp"

#include <coal/collision.h>
#include <coal/shape/convex.h>

#include <memory>
#include <vector>

/// coal (formerly hpp-fcl): its collision function with GJK and the expanding polytope, one contact asked for.
namespace {

class CoalPeer : public peer::Peer {
public:
	const char* name() const override { return "coal GJK+EPA"; }
	int         add(const peer::Body& body) override
	{
		auto points = std::make_shared<std::vector<coal::Vec3s>>();
		for (int i = 0; i < body.vertexCount; ++i)
			points->emplace_back(body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]);
		// faces as fans of triangles
		auto triangles = std::make_shared<std::vector<coal::Triangle>>();
		for (const int* face = body.faces; face != body.faces + body.faceLength; face += *face + 1)
			for (int k = 2; k < *face; ++k)
				triangles->emplace_back(std::size_t(face[1]), std::size_t(face[k]), std::size_t(face[k + 1]));
		bodies_.push_back(std::make_unique<coal::Convex<coal::Triangle>>(
		        points, unsigned(points->size()), triangles, unsigned(triangles->size())));
		return int(bodies_.size()) - 1;
	}
	peer::Answer query(int body1, const peer::Pose& pose1, int body2, const peer::Pose& pose2) override
	{
		result_.clear();
		coal::collide(bodies_[std::size_t(body1)].get(), transform(pose1), bodies_[std::size_t(body2)].get(), transform(pose2),
		        request_, result_);
		if (!result_.isCollision()) return { false, false, 0, { 0, 0, 0 } };
		const auto& contact = result_.getContact(0);
		return { true, true, -contact.penetration_depth, { contact.normal[0], contact.normal[1], contact.normal[2] } };
	}

private:
	static coal::Transform3s transform(const peer::Pose& pose)
	{
		return coal::Transform3s(coal::Matrix3s(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation)),
		        coal::Vec3s(pose.centre[0], pose.centre[1], pose.centre[2]));
	}
	std::vector<std::unique_ptr<coal::Convex<coal::Triangle>>> bodies_;
	coal::CollisionRequest                                     request_ { coal::CONTACT, 1 };
	coal::CollisionResult                                      result_;
};

} // namespace

extern "C" peer::Peer* makeCoal() { return new CoalPeer; }
