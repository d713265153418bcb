// SPDX-License-Identifier: GPL-2.0-or-later
#include "Peer.hpp"

#include <coin/ClpSimplex.hpp>

#include <vector>

/// The linear programme (Eq. 9) by CLP: a new model for each pair, as YADE's PotentialBlock does it, or one model whose
/// rows are filled anew.
namespace {

class ClpPeer : public peer::Peer {
public:
	explicit ClpPeer(bool reused) : reused_(reused) { }
	const char* name() const override { return reused_ ? "CLP, one model reused" : "CLP, as YADE calls it"; }
	int         add(const peer::Body& body) override
	{
		bodies_.emplace_back(body.planes, body.planes + 4 * body.planeCount);
		return int(bodies_.size()) - 1;
	}
	peer::Answer query(int body1, const peer::Pose& pose1, int body2, const peer::Pose& pose2) override
	{
		place(bodies_[std::size_t(body1)], pose1, 0);
		place(bodies_[std::size_t(body2)], pose2, int(bodies_[std::size_t(body1)].size() / 4));
		const int rows = int((bodies_[std::size_t(body1)].size() + bodies_[std::size_t(body2)].size()) / 4);
		double    s;
		if (reused_) {
			if (rows != kept_.numberRows()) fill(kept_, rows);
			else {
				// rows are full: the matrix is stored by columns, all of one length
				double* elements = kept_.matrix()->getMutableElements();
				for (int j = 0; j < 4; ++j)
					for (int i = 0; i < rows; ++i)
						elements[j * rows + i] = normals_[4 * std::size_t(i) + std::size_t(j)];
				for (int i = 0; i < rows; ++i)
					kept_.setRowUpper(i, offsets_[std::size_t(i)]);
				kept_.allSlackBasis(true);
			}
			s = solve(kept_);
		} else {
			ClpSimplex model;
			fill(model, rows);
			s = solve(model);
		}
		return { s < 0, false, 0, { 0, 0, 0 } };
	}

private:
	void place(const std::vector<double>& planes, const peer::Pose& pose, int from)
	{
		normals_.resize(std::size_t(from) * 4 + planes.size());
		offsets_.resize(normals_.size() / 4);
		for (std::size_t i = 0; i < planes.size() / 4; ++i) {
			double* out = &normals_[4 * (std::size_t(from) + i)];
			double  d   = planes[4 * i + 3];
			for (int j = 0; j < 3; ++j) {
				out[j] = 0;
				for (int k = 0; k < 3; ++k)
					out[j] += pose.rotation[3 * j + k] * planes[4 * i + std::size_t(k)];
				d += out[j] * pose.centre[j];
			}
			out[3]                          = -1;
			offsets_[std::size_t(from) + i] = d;
		}
	}
	void fill(ClpSimplex& model, int rows)
	{
		model.resize(0, 4);
		for (int j = 0; j < 4; ++j) {
			model.setObjectiveCoefficient(j, j == 3);
			model.setColumnLower(j, -COIN_DBL_MAX);
			model.setColumnUpper(j, COIN_DBL_MAX);
		}
		const int index[] = { 0, 1, 2, 3 };
		for (int i = 0; i < rows; ++i)
			model.addRow(4, index, &normals_[4 * std::size_t(i)], -COIN_DBL_MAX, offsets_[std::size_t(i)]);
		model.setLogLevel(0);
		model.scaling(0);
		model.setPrimalTolerance(1e-9);
	}
	static double solve(ClpSimplex& model)
	{
		model.primal();
		return model.primalColumnSolution()[3];
	}

	bool                             reused_;
	ClpSimplex                       kept_;
	std::vector<std::vector<double>> bodies_;
	std::vector<double>              normals_, offsets_;
};

} // namespace

extern "C" peer::Peer* makeClpNew() { return new ClpPeer(false); }
extern "C" peer::Peer* makeClpReused() { return new ClpPeer(true); }
