// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"

namespace yade {

ContactCounters& PolytopeGeomFunctor::counters()
{
	const int thread = omp_get_thread_num();
	return counters_[thread < int(counters_.size()) ? thread : 0];
}

void PolytopeGeomFunctor::count(const polytope::ContactResult& result)
{
	ContactCounters& count = counters();
	++count.pairs;
	++count.statuses[int(result.status)];
	count.contacts += result.inContact;
	count.dismissed += result.dismissed;
	count.simplexPivots += result.simplexPivots;
	count.newtonIterations += result.newtonIterations;
	count.ipoptSolves += result.ipoptSolved;
	count.ipoptIterations += result.ipoptIterations;
	count.surfacesKept += result.surfaceKept;
	count.linear += result.linear;
	if (ofScene().timing) {
		count.lpNanoseconds += result.lpNanoseconds;
		count.centreNanoseconds += result.centreNanoseconds;
		count.timedPairs += result.hasGeometry && !result.linear;
	}
}

boost::python::dict PolytopeGeomFunctor::stats() const
{
	ContactCounters sum;
	for (const ContactCounters& one : counters_) {
		sum.pairs += one.pairs;
		sum.contacts += one.contacts;
		sum.dismissed += one.dismissed;
		sum.simplexPivots += one.simplexPivots;
		sum.newtonIterations += one.newtonIterations;
		sum.ipoptSolves += one.ipoptSolves;
		sum.ipoptIterations += one.ipoptIterations;
		sum.surfacesKept += one.surfacesKept;
		sum.linear += one.linear;
		sum.lpNanoseconds += one.lpNanoseconds;
		sum.centreNanoseconds += one.centreNanoseconds;
		sum.timedPairs += one.timedPairs;
		for (int k = 0; k < polytope::contactStatusCount; ++k)
			sum.statuses[k] += one.statuses[k];
	}
	using polytope::ContactStatus;
	const auto          of = [&](ContactStatus status) { return sum.statuses[int(status)]; };
	boost::python::dict all, statuses;
	long                unanswered = 0;
	for (int k = 0; k < polytope::contactStatusCount; ++k) {
		statuses[polytope::statusName(ContactStatus(k))] = sum.statuses[k];
		if (!polytope::answered(ContactStatus(k))) unanswered += sum.statuses[k];
	}
	all["pairs"]            = sum.pairs;
	all["contacts"]         = sum.contacts;
	all["dismissed"]        = sum.dismissed;
	all["simplexPivots"]    = sum.simplexPivots;
	all["newtonIterations"] = sum.newtonIterations;
	all["ipoptSolves"]      = sum.ipoptSolves;
	all["ipoptIterations"]  = sum.ipoptIterations;
	all["surfacesKept"]     = sum.surfacesKept;
	all["linear"]           = sum.linear;
	all["rescued"]          = of(ContactStatus::CentreByIpopt);
	all["fallbacks"]        = unanswered - of(ContactStatus::Failed);
	all["failures"]         = unanswered;
	all["statuses"]         = statuses;
	if (Ig2_Polytope_Polytope_PolytopeGeom::orDefault(*Omega::instance().getScene()).timing) {
		all["timedPairs"]    = sum.timedPairs;
		all["lpSeconds"]     = 1e-9 * double(sum.lpNanoseconds);
		all["centreSeconds"] = 1e-9 * double(sum.centreNanoseconds);
	}
	return all;
}

void PolytopeGeomFunctor::resetStats()
{
	for (ContactCounters& one : counters_)
		one = ContactCounters();
}

} // namespace yade
