# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy error of collisions without friction and damping: the paper's model, the contact model spring, YADE's own polyhedra and spheres.

200 random meetings of two regular solids, and cubes that bounce on a floor for 40 s: error against time step, corner radius and
overlap, and the damping that makes up for it. YADE's PotentialBlock and Polyhedra are measured where ./run bench has built them.
Ends with 1 if momentum is not kept, if an error that is the integrator's does not fall with the time step, or one that is the
contact's does.

	./run python tools/measure/accuracy/collisionEnergy.py            # five minutes
	./run python tools/measure/accuracy/collisionEnergy.py --quick    # fewer meetings, steps and settings: a minute
"""

import functools
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; the studies are small

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import count, paperParser, shown
from boon2012.reporting.script import conclude
from collisionStudy.report import EnergyStudy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / 'peers'))
from collisionEnergyPeer import measure, names


def main(arguments=None):
	parser = paperParser(__doc__, quick='fewer meetings, steps and settings')
	parser.set_defaults(output=pathlib.Path('output/accuracy/collisionEnergy'))
	parser.add_argument('--number', type=count, default=None, help='of meetings (200; quick: 60)')
	parser.add_argument('--seed', type=count, default=1, help='of the meetings')
	given = parser.parse_args(arguments)
	given.number = given.number or (60 if given.quick else 200)
	findings = Findings('', 'Energy of collisions', given.output, shown(given))
	peers = {f"YADE's {name}": functools.partial(measure, method) for method, name in names.items()}
	EnergyStudy(given, findings, peers).all()
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main(sys.argv[1:]))
