// SPDX-License-Identifier: GPL-2.0-or-later
#include "bolt/BoltChain.hpp"

#include "bolt/BoltTolerances.hpp"

#include <algorithm>

namespace polytope {

namespace {

	Real clamped(const Real& value, const Real& limit) { return std::max(Real(-limit), std::min(value, limit)); }

} // namespace

void BoltChain::prepare()
{
	none_.assign(elements.size(), 0);
	for (auto* numbers : { &slips_, &trial_, &residual_, &step_, &diagonal_, &across_ })
		numbers->assign(nodes.size(), 0);
}

BoltChain::Answer BoltChain::steel(const BoltElement& element, const Real& elongation) const
{
	if (element.broken) return { 0, 0 };
	const Real elastic = element.stiffness * (elongation + element.locked - element.plastic);
	if (element.slackens && elastic <= 0) return { 0, 0 };
	if (unlimited_ || abs(elastic) < yieldForce) return { elastic, element.stiffness };
	return { clamped(elastic, yieldForce), 0 };
}

BoltChain::Answer BoltChain::grout(const BoltNode& node, const Real& slip) const
{
	const Real elastic = node.stiffness * (slip - node.plasticSlip), kept = tolerance::keptStiffness * node.stiffness;
	if (unlimited_ || abs(elastic) < node.strength) return { elastic + kept * slip, node.stiffness + kept };
	return { clamped(elastic, node.strength) + kept * slip, kept };
}

/// Elongation of an element by its opening and the slips at both ends.
Real BoltChain::elongation(std::size_t element, const std::vector<Real>& slips) const
{
	const long before = nodeBefore(element), after = before + 1;
	Real       sum = (*openings_)[element];
	if (after < long(slips.size())) sum += slips[std::size_t(after)];
	if (before >= 0) sum -= slips[std::size_t(before)];
	return sum;
}

BoltChain::Answer BoltChain::elementAt(std::size_t element, const std::vector<Real>& slips) const
{
	if (jacking_ && element == 0) return { jackingForce_, 0 };
	return steel(elements[element], elongation(element, slips));
}

/// Residuals of the nodes for these slips, and the matrix.
void BoltChain::evaluate(const std::vector<Real>& slips)
{
	largestForce_ = 0;
	for (std::size_t i = 0; i < nodes.size(); ++i) {
		const Answer held = grout(nodes[i], slips[i]);
		residual_[i]      = -held.force;
		largestForce_     = std::max(largestForce_, Real(abs(held.force)));
		diagonal_[i]      = held.tangent;
		across_[i]        = 0;
	}
	for (std::size_t e = 0; e < elements.size(); ++e) {
		const Answer drawn  = elementAt(e, slips);
		const long   before = nodeBefore(e), after = before + 1;
		const bool   first = before >= 0, second = after < long(nodes.size());
		largestForce_ = std::max(largestForce_, Real(abs(drawn.force)));
		if (first) residual_[std::size_t(before)] += drawn.force;
		if (second) residual_[std::size_t(after)] -= drawn.force;
		if (first) diagonal_[std::size_t(before)] += drawn.tangent;
		if (second) diagonal_[std::size_t(after)] += drawn.tangent;
		if (first && second) across_[std::size_t(before)] = -drawn.tangent;
	}
}

Real BoltChain::largestResidual() const
{
	Real largest = 0;
	for (const Real& one : residual_)
		largest = std::max(largest, Real(abs(one)));
	return largest;
}

/// Solves the symmetric tridiagonal system; the matrix is used up.
void BoltChain::newtonStep()
{
	const std::size_t count = nodes.size();
	step_                   = residual_;
	for (std::size_t i = 1; i < count; ++i) {
		const Real factor = across_[i - 1] / diagonal_[i - 1];
		diagonal_[i] -= factor * across_[i - 1];
		step_[i] -= factor * step_[i - 1];
	}
	for (std::size_t i = count; i-- > 0;) {
		if (i + 1 < count) step_[i] -= across_[i] * step_[i + 1];
		step_[i] /= diagonal_[i];
	}
}

/// How fast the energy falls along the step, at the last evaluated slips.
Real BoltChain::descent() const
{
	Real sum = 0;
	for (std::size_t i = 0; i < nodes.size(); ++i)
		sum += residual_[i] * step_[i];
	return sum;
}

/// Takes as much of the step as lowers the energy: its slope along the step only rises. Residuals and matrix are those of the slips taken. False if
/// nothing of the step lowers it.
bool BoltChain::search(const Real& first)
{
	Real low = 0, high = 1, part = 1;
	for (int halving = 0; halving < tolerance::mostCuts; ++halving) {
		for (std::size_t i = 0; i < nodes.size(); ++i)
			trial_[i] = slips_[i] + part * step_[i];
		evaluate(trial_);
		const Real slope = descent();
		if (slope >= -first / 2 && (part == 1 || slope <= first / 2)) {
			slips_.swap(trial_);
			return true;
		}
		(slope > 0 ? low : high) = part;
		part                     = low > 0 ? Real((low + high) / 2) : Real(high * tolerance::firstCut);
	}
	for (std::size_t i = 0; i < nodes.size(); ++i)
		slips_[i] += low * step_[i];
	evaluate(slips_);
	return low > 0;
}

/// Whether the step is less than the digits of the slips.
bool BoltChain::isRounding() const
{
	Real largest = 0, farthest = 0;
	for (std::size_t i = 0; i < nodes.size(); ++i) {
		largest  = std::max(largest, Real(abs(step_[i])));
		farthest = std::max(farthest, Real(abs(slips_[i])));
	}
	return largest <= 4 * std::numeric_limits<Real>::epsilon() * farthest;
}

bool BoltChain::balance()
{
	for (std::size_t i = 0; i < nodes.size(); ++i)
		slips_[i] = nodes[i].slip;
	evaluate(slips_);
	for (int step = 0; step < tolerance::mostNewtonSteps; ++step) {
		if (largestResidual() <= tolerance::boltBalance * largestForce_) return true;
		newtonStep();
		if (isRounding()) return true;
		if (!search(descent())) return false;
	}
	return false;
}

/// The slips found are the state from now on; returns whether anything flowed.
bool BoltChain::commit()
{
	bool flowed = false;
	for (std::size_t i = 0; i < nodes.size(); ++i) {
		BoltNode& node     = nodes[i];
		node.slip          = slips_[i];
		node.force         = grout(node, node.slip).force;
		const Real elastic = node.stiffness * (node.slip - node.plasticSlip);
		if (unlimited_ || !(abs(elastic) > node.strength)) continue;
		node.plasticSlip = node.slip - clamped(elastic, node.strength) / node.stiffness;
		flowed           = true;
	}
	for (std::size_t e = 0; e < elements.size(); ++e) {
		BoltElement& element = elements[e];
		element.force        = elementAt(e, slips_).force;
		if ((jacking_ && e == 0) || element.broken) continue; // the strain of a broken one stays that at which it broke
		element.strain     = strainOf(e);
		const Real now     = elongation(e, slips_) + element.locked;
		const Real elastic = element.stiffness * (now - element.plastic);
		if (unlimited_ || !(abs(elastic) > yieldForce) || (element.slackens && elastic <= 0)) continue;
		element.plastic = now - clamped(elastic, yieldForce) / element.stiffness;
		flowed          = true;
	}
	return flowed;
}

/// Strain at the present slips: that of the tension, and what is beyond it or plastic already.
Real BoltChain::strainOf(std::size_t index) const
{
	const BoltElement& element = elements[index];
	const Real         now = elongation(index, slips_) + element.locked, force = steel(element, now - element.locked).force;
	if (element.slackens && force == 0) return element.plastic / element.length;
	return force / axialStiffness + (now - force / element.stiffness) / element.length;
}

/// Breaks the most strained of the elements that are longer than the steel bears, and returns whether there was one.
bool BoltChain::breakLongest()
{
	BoltElement* longest = nullptr;
	for (std::size_t e = 0; e < elements.size(); ++e) {
		BoltElement& element = elements[e];
		if (element.broken) continue;
		element.strain = strainOf(e);
		if (element.strain > ruptureStrain && (!longest || element.strain > longest->strain)) longest = &element;
	}
	if (longest) longest->broken = true;
	return longest;
}

BoltChain::Change BoltChain::solve(const std::vector<Real>& openings, bool unlimited)
{
	Change change;
	openings_     = &openings;
	unlimited_    = unlimited;
	change.solved = balance();
	while (!unlimited && breakLongest()) {
		change.broke  = true;
		change.solved = balance() && change.solved;
	}
	change.flowed = commit();
	return change;
}

BoltChain::Change BoltChain::jack(const Real& force)
{
	BoltElement& head = elements.front();
	jackingForce_     = force;
	jacking_          = true;
	const Change made = solve(none_);
	jacking_          = false;
	openings_         = &none_;
	head.locked       = force / head.stiffness - elongation(0, slips_);
	head.strain       = force / axialStiffness;
	return made;
}

Real BoltChain::elasticStiffness(std::size_t element)
{
	const Real stiffness = elements[element].stiffness;
	const long before = nodeBefore(element), after = before + 1;
	std::fill(across_.begin(), across_.end(), 0);
	std::fill(residual_.begin(), residual_.end(), 0);
	for (std::size_t i = 0; i < nodes.size(); ++i)
		diagonal_[i] = nodes[i].stiffness;
	for (std::size_t e = 0; e < elements.size(); ++e) {
		const long one = nodeBefore(e), other = one + 1;
		const Real own = elements[e].stiffness;
		if (one >= 0) diagonal_[std::size_t(one)] += own;
		if (other < long(nodes.size())) diagonal_[std::size_t(other)] += own;
		if (one >= 0 && other < long(nodes.size())) across_[std::size_t(one)] = -own;
	}
	if (before >= 0) residual_[std::size_t(before)] = stiffness;
	if (after < long(nodes.size())) residual_[std::size_t(after)] = -stiffness;
	newtonStep();
	Real elongated = 1;
	if (after < long(nodes.size())) elongated += step_[std::size_t(after)];
	if (before >= 0) elongated -= step_[std::size_t(before)];
	return stiffness * elongated;
}

Real BoltChain::energy() const
{
	Real sum = 0;
	for (const BoltElement& element : elements)
		if (!element.broken) sum += element.force * element.force / (2 * element.stiffness);
	for (const BoltNode& node : nodes) {
		const Real kept = tolerance::keptStiffness * node.stiffness * node.slip, elastic = node.force - kept;
		sum += elastic * elastic / (2 * node.stiffness) + kept * node.slip / 2;
	}
	return sum;
}

Real BoltChain::groutStrength() const
{
	Real sum = 0;
	for (const BoltNode& node : nodes)
		sum += node.strength;
	return sum;
}

} // namespace polytope
