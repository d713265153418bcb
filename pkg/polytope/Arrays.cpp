// SPDX-License-Identifier: GPL-2.0-or-later
#include "Arrays.hpp"

#include "PolytopeGeom.hpp"
#include "Prefetch.hpp"
#include "RockJoint.hpp"

#include <core/Body.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include <boost/python.hpp>

#include <array>
#include <limits>
#include <map>
#include <sys/mman.h>
#include <typeinfo>

namespace py = boost::python;

namespace yade {
namespace {

	constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
	/// Entries between the one that is written and the one whose memory is called into the cache: each of both steps (the interaction,
	/// then what it refers to) has the time of as many entries.
	constexpr std::size_t ahead = 12;

	/// Asks for large pages in memory that will be written from end to end: a fault for each 4 kB costs as much as what is written there.
	void wantLargePages(char* memory, std::size_t bytes)
	{
		constexpr std::uintptr_t page  = 4096;
		const auto               begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
		const auto               end   = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
		if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE); // not to be had: small ones
	}

	/// Columns of one length, each the memory of a later NumPy array (a bytearray: no header of NumPy is needed to build).
	class Table {
	public:
		explicit Table(std::size_t rows) : rows_(rows) { }

		/// Memory of rows × `width` numbers of the type, which the dictionary owns.
		template <class Number> Number* column(const char* name, int width = 1)
		{
			const std::size_t bytes  = rows_ * std::size_t(width) * sizeof(Number);
			PyObject* const   memory = PyByteArray_FromStringAndSize(nullptr, Py_ssize_t(bytes));
			const py::object  owner { py::handle<>(memory) }; // throws if there is no memory
			wantLargePages(PyByteArray_AS_STRING(memory), bytes);
			columns_[name] = py::make_tuple(owner, std::is_same<Number, double>::value ? "float64" : "int32", width);
			return reinterpret_cast<Number*>(PyByteArray_AS_STRING(memory));
		}

		py::dict columns() const { return columns_; }

	private:
		std::size_t rows_;
		py::dict    columns_;
	};

	void put(double* column, std::size_t row, const Vector3r& vector)
	{
		for (int k = 0; k < 3; ++k)
			column[3 * row + std::size_t(k)] = double(vector[k]);
	}

	/// Replaces the class indices in `shapes` by numbers of the classes in the order in which they are met, -1 for no shape; \returns their names.
	py::tuple numberShapes(const std::vector<const Body*>& bodies, int* shapes)
	{
		std::map<int, int> codes;
		py::list           names;
		for (std::size_t row = 0; row < bodies.size(); ++row) {
			const Shape* const shape = bodies[row]->shape.get();
			if (!shape) continue;
			const auto found = codes.emplace(shapes[row], int(codes.size()));
			if (found.second) names.append(shape->getClassName());
			shapes[row] = found.first->second;
		}
		return py::tuple(names);
	}

	std::vector<const Body*> bodiesOf(const Scene& scene)
	{
		std::vector<const Body*> bodies;
		bodies.reserve(scene.bodies->size());
		for (std::size_t k = 0; k < scene.bodies->size(); ++k) {
			if (k + ahead < scene.bodies->size()) prefetch::fetch((*scene.bodies)[Body::id_t(k + ahead)].get(), sizeof(Body));
			const auto& body = (*scene.bodies)[Body::id_t(k)];
			if (body && !body->getIsSubdomain()) bodies.push_back(body.get()); // those stand for ranks (docs/mpi.md)
		}
		return bodies;
	}

	/// \returns (columns, names of the shapes' classes)
	py::tuple bodyColumns()
	{
		Scene* const                   scene  = Omega::instance().getScene().get();
		const std::vector<const Body*> bodies = bodiesOf(*scene);
		scene->forces.sync();

		Table       table(bodies.size());
		auto* const ids               = table.column<int>("ids");
		auto* const shapes            = table.column<int>("shapes");
		auto* const clumpIds          = table.column<int>("clumpIds");
		auto* const masks             = table.column<int>("masks");
		auto* const masses            = table.column<double>("masses");
		auto* const positions         = table.column<double>("positions", 3);
		auto* const orientations      = table.column<double>("orientations", 4);
		auto* const velocities        = table.column<double>("velocities", 3);
		auto* const angularVelocities = table.column<double>("angularVelocities", 3);
		auto* const forces            = table.column<double>("forces", 3);
		auto* const torques           = table.column<double>("torques", 3);
#pragma omp parallel for schedule(static)
		for (std::size_t row = 0; row < bodies.size(); ++row) {
			if (row + 2 * ahead < bodies.size()) prefetch::fetch(bodies[row + 2 * ahead], sizeof(Body));
			if (row + ahead < bodies.size()) {
				prefetch::fetch(bodies[row + ahead]->state.get(), sizeof(State));
				prefetch::fetch(bodies[row + ahead]->shape.get(), sizeof(void*)); // its class
			}
			const Body&  body  = *bodies[row];
			const State& state = *body.state;
			ids[row]           = body.getId();
			shapes[row]        = body.shape ? body.shape->getClassIndex() : -1;
			clumpIds[row]      = body.clumpId;
			masks[row]         = int(body.groupMask);
			masses[row]        = double(state.mass);
			put(positions, row, state.pos);
			for (int k = 0; k < 4; ++k)
				orientations[4 * row + std::size_t(k)] = double(state.ori.coeffs()[k]);
			put(velocities, row, state.vel);
			put(angularVelocities, row, state.angVel);
			put(forces, row, scene->forces.getForce(body.getId()));
			put(torques, row, scene->forces.getTorque(body.getId()));
		}
		const py::tuple names = numberShapes(bodies, shapes);
		return py::make_tuple(table.columns(), names);
	}

	/// The object as this class, null if it is of another one. A dynamic_cast takes ten times as long.
	template <class Exact, class Object> const Exact* exactly(const Object* object)
	{
		return object && typeid(*object) == typeid(Exact) ? static_cast<const Exact*>(object) : nullptr;
	}

	const NormShearPhys* shearPhysOf(const IPhys* phys)
	{
		if (const auto* const own = exactly<RockJointPhys>(phys)) return own;
		if (const auto* const friction = exactly<FrictPhys>(phys)) return friction;
		return dynamic_cast<const NormShearPhys*>(phys);
	}

	/// What a row of contacts has from the geometry, by its class: all of PolytopeGeom, less of YADE's own, NaN for the rest.
	struct Meeting {
		Vector3r point = Vector3r::Constant(Real(notANumber)), normal = point;
		double   area = notANumber, depth = notANumber, infeasibility = notANumber;
		int      status = -1;

		explicit Meeting(const IGeom* geom)
		{
			if (const auto* const own = exactly<PolytopeGeom>(geom)) {
				point         = own->contactPoint;
				normal        = own->normal;
				depth         = double(own->penetrationDepth);
				area          = double(own->contactArea);
				infeasibility = double(own->infeasibility);
				status        = own->statusCode;
			} else if (const auto* const spheres = dynamic_cast<const GenericSpheresContact*>(geom)) {
				point  = spheres->contactPoint;
				normal = spheres->normal;
				if (const auto* const scGeom = dynamic_cast<const ScGeom*>(spheres))
					depth = double(scGeom->penetrationDepth);
			}
		}
	};

	/// Bytes between a PolytopeGeom and its status.
	std::size_t statusOffset()
	{
		static const PolytopeGeom geom;
		static const auto         offset
		        = std::size_t(reinterpret_cast<const char*>(&geom.statusCode) - reinterpret_cast<const char*>(&geom));
		return offset;
	}

	/// One row of contacts: what is needed of the interaction, and its parts.
	struct Row {
		const IGeom*       geom;
		const IPhys*       phys;
		std::array<int, 2> ids;
		std::array<int, 3> image;
	};

	/// What a row is made of, called into the cache; other geometries and physics are smaller.
	void fetchParts(const Row& row)
	{
		const char* const geom = reinterpret_cast<const char*>(row.geom);
		// both ends of PolytopeGeom's own attributes; what lies between them is the pair's memory
		prefetch::fetch(geom, sizeof(ScGeom) + 2 * sizeof(Real));
		prefetch::fetch(geom + statusOffset(), sizeof(int));
		prefetch::fetch(row.phys, sizeof(NormShearPhys));
	}

	/// Real contacts among the interactions from `begin` to before `end`.
	std::vector<Row> rowsBetween(const InteractionContainer& all, std::size_t begin, std::size_t end)
	{
		std::vector<Row> rows;
		for (std::size_t k = begin; k < end; ++k) {
			if (k + ahead < end) prefetch::fetch(all[k + ahead].get(), sizeof(Interaction));
			const auto& one = all[k];
			if (one && one->isReal())
				rows.push_back({ one->geom.get(), one->phys.get(), { one->getId1(), one->getId2() },
				        { one->cellDist[0], one->cellDist[1], one->cellDist[2] } });
		}
		return rows;
	}

	/// All real contacts, in parts that follow each other, one for each thread.
	std::vector<std::vector<Row>> rowsOfContacts(const Scene& scene)
	{
		const std::size_t             size = scene.interactions->size(), number = std::size_t(omp_get_max_threads());
		std::vector<std::vector<Row>> parts(number);
#pragma omp parallel for schedule(static)
		for (std::size_t part = 0; part < number; ++part)
			parts[part] = rowsBetween(*scene.interactions, size * part / number, size * (part + 1) / number);
		return parts;
	}

	/// Columns of contacts.
	class ContactTable {
	public:
		explicit ContactTable(std::size_t rows) : table_(rows) { }

		void write(std::size_t at, const Row& row)
		{
			const auto* const phys        = shearPhysOf(row.phys);
			const NormPhys*   push        = phys ? phys : dynamic_cast<const NormPhys*>(row.phys);
			const Vector3r    none        = Vector3r::Constant(Real(notANumber));
			const Vector3r    normalForce = push ? push->normalForce : none;
			const Vector3r    shearForce  = phys ? phys->shearForce : push ? Vector3r(Vector3r::Zero()) : none;
			const Meeting     meeting(row.geom);
			for (std::size_t k = 0; k < 2; ++k)
				ids_[2 * at + k] = row.ids[k];
			for (std::size_t k = 0; k < 3; ++k)
				images_[3 * at + k] = row.image[k];
			statuses_[at] = meeting.status;
			put(points_, at, meeting.point);
			put(normals_, at, meeting.normal);
			put(forces_, at, normalForce + shearForce);
			put(normalForces_, at, normalForce);
			put(shearForces_, at, shearForce);
			areas_[at]           = meeting.area;
			depths_[at]          = meeting.depth;
			infeasibilities_[at] = meeting.infeasibility;
		}

		py::dict columns() const { return table_.columns(); }

	private:
		Table         table_;
		int* const    ids_             = table_.column<int>("ids", 2);
		int* const    images_          = table_.column<int>("images", 3);
		int* const    statuses_        = table_.column<int>("statuses");
		double* const points_          = table_.column<double>("points", 3);
		double* const normals_         = table_.column<double>("normals", 3);
		double* const forces_          = table_.column<double>("forces", 3);
		double* const normalForces_    = table_.column<double>("normalForces", 3);
		double* const shearForces_     = table_.column<double>("shearForces", 3);
		double* const areas_           = table_.column<double>("areas");
		double* const depths_          = table_.column<double>("depths");
		double* const infeasibilities_ = table_.column<double>("infeasibilities");
	};

	/// \returns (columns, names of the statuses)
	py::tuple contactColumns()
	{
		const auto               parts = rowsOfContacts(*Omega::instance().getScene());
		std::vector<std::size_t> first { 0 }; // row of each part, and their number
		for (const auto& part : parts)
			first.push_back(first.back() + part.size());
		ContactTable table(first.back());
#pragma omp parallel for schedule(static)
		for (std::size_t part = 0; part < parts.size(); ++part) {
			const auto& rows = parts[part];
			for (std::size_t k = 0; k < rows.size(); ++k) {
				if (k + ahead < rows.size()) fetchParts(rows[k + ahead]);
				table.write(first[part] + k, rows[k]);
			}
		}
		py::list names;
		for (int code = 0; code < polytope::contactStatusCount; ++code)
			names.append(polytope::statusName(polytope::ContactStatus(code)));
		return py::make_tuple(table.columns(), py::tuple(names));
	}

} // namespace

void defineArrays()
{
	py::def("bodyColumns", &bodyColumns,
	        "Columns of all bodies that are there, name → (bytes, type, numbers per row), and the names of their shapes' classes.");
	py::def("contactColumns", &contactColumns, "The same of all real interactions, and the names of the statuses.");
}

} // namespace yade
