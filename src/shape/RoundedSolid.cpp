// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/RoundedSolid.hpp"

#include "shape/Rings.hpp"
#include "shape/SolidMoments.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace polytope {
namespace {

	using std::acos;
	using std::atan2;
	using std::cos;
	using std::sin;

	/// Edge from → to of face `left`, seen from outside; the same edge runs the other way in face `right`.
	struct Edge {
		int from, to, left, right;
	};

	/// Faces and edges of the core as the ball needs them.
	struct Neighbours {
		std::vector<Vector3>               normals; ///< of faces
		std::map<std::pair<int, int>, int> faceOf;  ///< of the edge from → to
		std::vector<Edge>                  edges;   ///< each once

		explicit Neighbours(const Polyhedron& core)
		{
			for (std::size_t f = 0; f < core.faces.size(); ++f) {
				normals.push_back(faceArea(core, f).normalized());
				int from = core.faces[f].back();
				for (int to : core.faces[f]) {
					faceOf[{ from, to }] = int(f);
					from                 = to;
				}
			}
			for (const auto& [ends, face] : faceOf)
				if (const auto back = faceOf.find({ ends.second, ends.first });
				        back != faceOf.end() && ends.first < ends.second)
					edges.push_back({ ends.first, ends.second, face, back->second });
		}
		const Vector3& normal(int face) const { return normals[std::size_t(face)]; }
	};

	/// Unit vectors between two, in the plane of both: from −angle/2 to angle/2 about the middle one.
	struct Arc {
		Vector3 middle = Vector3::Zero(), across = Vector3::Zero(), axis = Vector3::Zero();
		Real    angle = 0;

		Arc(const Vector3& from, const Vector3& to)
		{
			axis            = from.cross(to);
			const Real sine = axis.norm();
			if (!(sine > 0)) return;
			angle  = atan2(sine, from.dot(to));
			axis   = axis / sine;
			middle = (from + to).normalized();
			across = axis.cross(middle);
		}
		/// \param part of the way, 0 to 1
		Vector3 at(const Real& part) const
		{
			const Real turn = (part - Real(0.5)) * angle;
			return cos(turn) * middle + sin(turn) * across;
		}
	};

	Matrix3 square(const Vector3& v) { return v * v.transpose(); }
	Matrix3 both(const Vector3& a, const Vector3& b) { return a * b.transpose() + b * a.transpose(); }

	void addSlab(SolidMoments& sum, const Polyhedron& core, std::size_t f, const Vector3& normal, const Real& r)
	{
		const SolidMoments flat = faceMoments(core, f, normal, Vector3::Zero());
		sum.add(r * flat.zeroth, r * flat.first + r * r / 2 * flat.zeroth * normal,
		        r * flat.second + r * r / 2 * both(flat.first, normal) + r * r * r / 3 * flat.zeroth * square(normal));
	}

	void addSector(SolidMoments& sum, const Vector3& a, const Vector3& b, const Arc& arc, const Real& r)
	{
		const Vector3 middle = (a + b) / 2, along = b - a;
		const Real    length = along.norm(), part = arc.angle * r * r / 2;
		const Vector3 first = 2 * sin(arc.angle / 2) * arc.middle; // ∫ u dθ
		const Matrix3 second
		        = (arc.angle + sin(arc.angle)) / 2 * square(arc.middle) + (arc.angle - sin(arc.angle)) / 2 * square(arc.across);
		const Real cubed = r * r * r / 3;
		sum.add(length * part, length * (part * middle + cubed * first),
		        length * (part * (square(middle) + square(along) / 12) + cubed * both(middle, first) + r * r * r * r / 4 * second));
	}

	/// Angle at corner k of a face.
	Real cornerAngle(const Polyhedron& core, const std::vector<int>& face, std::size_t k)
	{
		const std::size_t n = face.size();
		const Vector3&    v = core.vertices[std::size_t(face[k])];
		const Vector3     a = core.vertices[std::size_t(face[(k + 1) % n])] - v,
		              b     = core.vertices[std::size_t(face[(k + n - 1) % n])] - v;
		return atan2(a.cross(b).norm(), a.dot(b));
	}

	/// Sectors of the ball: solid angles are what the faces' angles lack of a full turn (Gauss and Bonnet), ∫ w dΩ is half the sum over the
	/// sector's sides.
	void addBall(SolidMoments& sum, const Polyhedron& core, const Neighbours& of, const Real& r)
	{
		const Real           pi = acos(Real(-1));
		std::vector<Real>    angles(core.vertices.size(), 2 * pi);
		std::vector<Vector3> firsts(core.vertices.size(), Vector3::Zero());
		for (const std::vector<int>& face : core.faces)
			for (std::size_t k = 0; k < face.size(); ++k)
				angles[std::size_t(face[k])] -= cornerAngle(core, face, k);
		for (const Edge& edge : of.edges) {
			const Arc     arc(of.normal(edge.left), of.normal(edge.right)); // as `to` sees them, counter-clockwise
			const Vector3 half = arc.angle / 2 * arc.axis;
			firsts[std::size_t(edge.to)] += half;
			firsts[std::size_t(edge.from)] -= half;
		}
		const Real cubed = r * r * r / 3, fourth = cubed * r * 3 / 4;
		for (std::size_t v = 0; v < core.vertices.size(); ++v) {
			const Vector3& place = core.vertices[v];
			sum.add(cubed * angles[v], cubed * angles[v] * place + fourth * firsts[v],
			        cubed * angles[v] * square(place) + fourth * both(place, firsts[v]));
		}
		sum.second += 4 * pi / 15 * r * r * r * r * r * Matrix3::Identity();
	}

	/// Builds roundedSurface(): a vertex for each place and direction.
	class Surface {
	public:
		Surface(const Polyhedron& core, const Real& radius, const Real& angle)
		        : core_(core), of_(core), radius_(radius), angle_(angle)
		{
		}

		Polyhedron make()
		{
			for (std::size_t f = 0; f < core_.faces.size(); ++f) {
				std::vector<int> face;
				for (int v : core_.faces[f])
					face.push_back(corners_[{ v, int(f) }] = vertex(v, of_.normals[f]));
				add(face, core_.planeOfFace[f]);
			}
			for (const Edge& edge : of_.edges)
				addStrips(edge);
			for (std::size_t f = 0; f < core_.faces.size(); ++f)
				for (int v : core_.faces[f])
					if (patched_.insert(v).second) addPatch(v, int(f));
			return std::move(made_);
		}

	private:
		int vertex(int v, const Vector3& direction)
		{
			made_.vertices.push_back(core_.vertices[std::size_t(v)] + radius_ * direction);
			return int(made_.vertices.size()) - 1;
		}
		void add(std::vector<int> face, int plane)
		{
			made_.faces.push_back(std::move(face));
			made_.planeOfFace.push_back(plane);
		}
		int parts(const Real& angle) const { return std::max(1, int(std::ceil(double(angle / angle_)))); }

		/// Adds the strips along an edge; its arcs at both ends, as vertices from the one face to the other, are kept for the patches there.
		void addStrips(const Edge& edge)
		{
			const Arc         arc(of_.normal(edge.left), of_.normal(edge.right));
			const int         count = parts(arc.angle);
			std::vector<int>& from  = arcs_[{ edge.from, edge.to }];
			std::vector<int>& to    = arcs_[{ edge.to, edge.from }];
			for (int k = 0; k <= count; ++k) {
				const bool first = k == 0, last = k == count;
				const int  face = first ? edge.left : edge.right;
				const auto at   = [&](int v) {
                                        return first || last ? corners_.at({ v, face }) : vertex(v, arc.at(Real(k) / Real(count)));
				};
				from.push_back(at(edge.from));
				to.push_back(at(edge.to));
				if (!first) {
					const std::size_t now = std::size_t(k);
					add({ to[now - 1], from[now - 1], from[now], to[now] }, -1);
				}
			}
			std::reverse(from.begin(), from.end()); // counter-clockwise as each end sees it
		}

		/// The arcs around a vertex one after the other, counter-clockwise, from that face on.
		std::vector<int> ringAround(int v, int first) const
		{
			std::vector<int> ring;
			int              face = first;
			do {
				const std::vector<int>& corners = core_.faces[std::size_t(face)];
				const auto              place   = std::find(corners.begin(), corners.end(), v);
				const int               before  = place == corners.begin() ? corners.back() : *(place - 1);
				const std::vector<int>& arc     = arcs_.at({ v, before });
				ring.insert(ring.end(), arc.begin(), arc.end() - 1);
				face = of_.faceOf.at({ v, before });
			} while (face != first);
			return ring;
		}

		void addPatch(int v, int face)
		{
			std::vector<int>     ring = ringAround(v, face);
			const std::size_t    n    = ring.size();
			std::vector<Vector3> ends;
			Vector3              middle = Vector3::Zero();
			for (int corner : ring) {
				ends.push_back((made_.vertices[std::size_t(corner)] - core_.vertices[std::size_t(v)]) / radius_);
				middle += ends.back();
			}
			middle.normalize();
			Real widest = 0;
			for (const Vector3& end : ends)
				widest = std::max(widest, Arc(end, middle).angle);
			const int levels = parts(widest);
			for (int level = 1; level < levels; ++level) {
				std::vector<int> inner;
				for (const Vector3& end : ends)
					inner.push_back(vertex(v, Arc(end, middle).at(Real(level) / Real(levels))));
				for (std::size_t k = 0; k < n; ++k) {
					const std::size_t next = (k + 1) % n;
					add({ ring[k], ring[next], inner[next] }, -1);
					add({ ring[k], inner[next], inner[k] }, -1);
				}
				ring = std::move(inner);
			}
			const int top = vertex(v, middle);
			for (std::size_t k = 0; k < n; ++k)
				add({ ring[k], ring[(k + 1) % n], top }, -1);
		}

		const Polyhedron&                               core_;
		Neighbours                                      of_;
		Real                                            radius_, angle_;
		Polyhedron                                      made_;
		std::map<std::pair<int, int>, int>              corners_; ///< of a vertex and a face
		std::map<std::pair<int, int>, std::vector<int>> arcs_;    ///< of a vertex and the other end of an edge
		std::set<int>                                   patched_;
	};

} // namespace

MassProperties roundedMass(const Polyhedron& core, const Real& radius)
{
	if (!(radius >= 0)) throw std::invalid_argument("margin: must be at least 0");
	MassProperties mass = massProperties(core);
	if (radius == 0) return mass;
	const auto   spread = [](const Matrix3& inertia) { return Matrix3(inertia.trace() / 2 * Matrix3::Identity() - inertia); };
	SolidMoments sum; // about the core's centroid
	sum.add(mass.volume, Vector3::Zero(), spread(mass.inertia));
	Polyhedron about = core;
	for (Vector3& vertex : about.vertices)
		vertex -= mass.centroid;
	const Neighbours of(about);
	for (std::size_t f = 0; f < about.faces.size(); ++f)
		addSlab(sum, about, f, of.normals[f], radius);
	for (const Edge& edge : of.edges)
		addSector(sum, about.vertices[std::size_t(edge.from)], about.vertices[std::size_t(edge.to)],
		        Arc(of.normal(edge.left), of.normal(edge.right)), radius);
	addBall(sum, about, of, radius);

	const Vector3 way    = sum.first / sum.zeroth;
	const Matrix3 second = sum.second - sum.zeroth * square(way);
	mass.volume          = sum.zeroth;
	mass.centroid += way;
	mass.inertia = second.trace() * Matrix3::Identity() - second;
	return mass;
}

Polyhedron roundedSurface(const Polyhedron& core, const Real& radius, const Real& angle)
{
	return radius > 0 ? Surface(core, radius, angle).make() : core;
}

} // namespace polytope
