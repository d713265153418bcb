// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PolytopeGeom.hpp"
#include "host/ExactClass.hpp"
#include "host/Prefetch.hpp"
#include "joint/RockJointPhys.hpp"
#include "python/ArrayTable.hpp"
#include "python/Arrays.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include <limits>

namespace py = boost::python;

namespace yade {
namespace {

	using namespace arrays;

	constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

	const NormShearPhys* shearPhysOf(const IPhys* phys)
	{
		if (const auto* const own = exactly<RockJointPhys>(phys)) return own;
		if (const auto* const friction = exactly<FrictPhys>(phys)) return friction;
		return dynamic_cast<const NormShearPhys*>(phys);
	}

	/// What a row of contacts has of YADE's own geometries: NaN where they have not.
	struct OtherGeom {
		Vector3r point = Vector3r::Constant(Real(notANumber)), normal = point;
		double   depth = notANumber;

		explicit OtherGeom(const IGeom* geom)
		{
			const auto* const spheres = dynamic_cast<const GenericSpheresContact*>(geom);
			if (!spheres) return;
			point  = spheres->contactPoint;
			normal = spheres->normal;
			if (const auto* const scGeom = dynamic_cast<const ScGeom*>(spheres)) depth = double(scGeom->penetrationDepth);
		}
	};

	/// What a row of contacts reads of one object: the bytes from its first attribute to the end of its last one.
	struct Span {
		std::size_t begin, bytes;
	};
	template <class Object, class First, class Last> Span spanOf(const Object& object, const First& first, const Last& last)
	{
		const auto at = [&](const void* part) {
			return std::size_t(static_cast<const char*>(part) - reinterpret_cast<const char*>(&object));
		};
		return { at(&first), at(&last) + sizeof(Last) - at(&first) };
	}

	/// One row of contacts.
	struct Row {
		const Interaction* one;
		const IGeom*       geom;
		const IPhys*       phys;
	};

	/// What a row is made of, called into the cache; other geometries and physics are smaller.
	void fetchParts(const Row& row)
	{
		static const Interaction  pair(0, 0);
		static const PolytopeGeom geom;
		static const Span names = spanOf(pair, pair.getId1(), pair.cellDist), place = spanOf(geom, geom.normal, geom.contactPoint),
		                  outcome = spanOf(geom, geom.penetrationDepth, geom.statusCode);
		prefetch::fetch(reinterpret_cast<const char*>(row.one) + names.begin, names.bytes);
		prefetch::fetch(row.geom, place.begin + place.bytes);
		prefetch::fetch(reinterpret_cast<const char*>(row.geom) + outcome.begin, outcome.bytes);
		prefetch::fetch(row.phys, sizeof(NormShearPhys));
	}

	/// Real contacts among the interactions from `begin` to before `end`. Most pairs have no geometry: nothing else is read of them.
	std::vector<Row> rowsBetween(const InteractionContainer& all, std::size_t begin, std::size_t end)
	{
		std::vector<Row> rows;
		rows.reserve(end - begin); // what no row is written to is never touched
		wantLargePages(rows.data(), rows.capacity() * sizeof(Row));
		for (std::size_t k = begin; k < end; ++k) {
			if (k + 2 * ahead < end)
				if (const Interaction* const later = all[k + 2 * ahead].get()) prefetch::fetch(&later->geom, sizeof(void*));
			const Interaction* const one = all[k].get();
			if (one && one->isReal()) rows.push_back({ one, one->geom.get(), one->phys.get() });
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
			const auto* const phys = shearPhysOf(row.phys);
			ids_[2 * at]           = row.one->getId1();
			ids_[2 * at + 1]       = row.one->getId2();
			for (int k = 0; k < 3; ++k)
				images_[3 * at + std::size_t(k)] = row.one->cellDist[k];
			if (phys) writeForces(at, phys->normalForce, phys->shearForce);
			else if (const auto* const push = dynamic_cast<const NormPhys*>(row.phys))
				writeForces(at, push->normalForce, Vector3r::Zero());
			else writeForces(at, Vector3r::Constant(Real(notANumber)), Vector3r::Constant(Real(notANumber)));
			if (const auto* const own = asClass<PolytopeGeom>(row.geom)) {
				writePlace(at, own->contactPoint, own->normal, double(own->penetrationDepth));
				areas_[at]           = double(own->contactArea);
				infeasibilities_[at] = double(own->infeasibility);
				statuses_[at]        = own->statusCode;
			} else {
				const OtherGeom geom(row.geom);
				writePlace(at, geom.point, geom.normal, geom.depth);
				areas_[at] = infeasibilities_[at] = notANumber;
				statuses_[at]                     = -1;
			}
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

		void writeForces(std::size_t at, const Vector3r& normalForce, const Vector3r& shearForce)
		{
			put(normalForces_, at, normalForce);
			put(shearForces_, at, shearForce);
			for (int k = 0; k < 3; ++k)
				forces_[3 * at + std::size_t(k)] = double(Real(normalForce[k] + shearForce[k]));
		}

		void writePlace(std::size_t at, const Vector3r& point, const Vector3r& normal, double depth)
		{
			put(points_, at, point);
			put(normals_, at, normal);
			depths_[at] = depth;
		}
	};

} // namespace

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

} // namespace yade
