# SPDX-License-Identifier: GPL-2.0-or-later
"""How many wrong operators, signs and numbers in the sources the tests notice.

	./run python tools/measure/mutation/mutation.py --mutants 400 --minutes 60

Picks places in kernel, construction and law by chance (--seed), builds a copy of the project with all of them in it, one of which the
environment switches on, and runs for each the tests that reach it until one fails. Writes results.json, with what no test noticed. The same call
goes on where it was ended.
"""

import argparse
import datetime
import hashlib
import json
import os
import pathlib
import platform
import random
import subprocess
import time

from killers import CoreTests, PluginTests
from schemata import Schemata, project
from sites import Mutant, sites

core = tuple(str(folder.relative_to(project)) for folder in sorted((project / 'src').iterdir()) if folder.is_dir())
plugin = tuple(
	f'pkg/polytope/{name}.cpp'
	for name in '''joint/RockJointLaw joint/Ip2_RockJointMat_RockJointMat_RockJointPhys joint/RockJointShear
	contact/PolytopeGeom contact/Ig2_Polytope_Polytope_PolytopeGeom contact/ContactCounters'''.split()
)
pluginTests = (
	'test_contact_physics.py test_rock_joint.py test_joint_history.py test_bounds.py test_spring.py test_energy.py test_mechanical_energy.py'
).split()
shareOfConstants = 0.15
shareOfPlugin = 0.2


def chosen(count, seed, files=('',)):
	"""So many mutants, drawn from files whose names contain one of *files*, each place at most once."""
	chance = random.Random(seed)
	places = {True: [], False: []}
	for folder in core:
		for path in sorted((project / folder).glob('*.[ch]pp')):
			if not path.name.endswith('Tolerances.hpp'):  # computed by the compiler
				places[False] += sites(path, str(path.relative_to(project)))
	for name in plugin:
		places[True] += sites(project / name, name)
	for ofPlugin, some in places.items():
		places[ofPlugin] = [place for place in some if any(part in place[0] for part in files)]
	shares = {True: shareOfPlugin, False: 1 - shareOfPlugin} if places[True] and places[False] else {True: 1, False: 1}
	found = []
	for ofPlugin in (False, True):
		for constant, part in ((False, 1 - shareOfConstants), (True, shareOfConstants)):
			some = [place for place in places[ofPlugin] if (place[3] == 'constant') == constant]
			found += chance.sample(some, min(len(some), round(count * shares[ofPlugin] * part)))
	# numbers follow the files, so that one choice is the same program whatever is taken out of it
	return [
		Mutant(i + 1, *place[:5], chance.choice(place[5]), place[6]) for i, place in enumerate(sorted(found, key=lambda place: place[:3]))
	]


def sourcesKey():
	"""What results belong to: the sources that are mutated, not the tests, which may grow until nothing survives."""
	digest = hashlib.sha256()
	for folder in (*core, 'pkg/polytope'):
		for path in sorted((project / folder).rglob('*.[ch]pp')):
			digest.update(path.read_bytes())
	digest.update((pathlib.Path(__file__).parent / 'sites.py').read_bytes())
	return digest.hexdigest()[:16]


def head(arguments):
	git = ['git', '-c', f'safe.directory={project}', '-C', str(project), 'describe', '--always', '--exclude=*', '--abbrev=40', '--dirty']
	try:
		revision = subprocess.run(git, capture_output=True, text=True).stdout.strip()
	except OSError:
		revision = ''
	model = [line.split(':')[1].strip() for line in open('/proc/cpuinfo') if line.startswith('model name')]
	return {
		'program': 'tools/measure/mutation/mutation.py',
		'revision': revision or 'unknown',
		'sources': sourcesKey(),
		'seed': arguments.seed,
		'asked': arguments.mutants,
		'files': arguments.file,
		'date': datetime.datetime.now(datetime.UTC).strftime('%Y-%m-%d'),
		'machine': f'{(model or ["?"])[0]}, {platform.machine()}',
	}


def write(path, results):
	"""One mutant a line."""
	rows = ',\n'.join('  ' + json.dumps(row) for row in results['mutants'])
	rest = (
		json.dumps({key: value for key, value in results.items() if key != 'mutants'}, indent=1).replace('\n  ', ' ').replace('\n ]', ']')
	)
	path.write_text(rest[:-2] + ',\n "mutants": [\n' + rows + '\n ]\n}\n')


def judged(mutants, verdict, tests, row, results, path, end, say):
	"""Runs the tests for each mutant until the time is over; a row for each in the file."""
	done = {entry['id']: entry for entry in results['mutants']}
	for mutant in mutants:
		if time.monotonic() > end:
			break
		if mutant.id in done and (done[mutant.id]['killedBy'] or row in done[mutant.id]['ran']):
			continue
		entry = done.setdefault(mutant.id, {**mutant.row(), 'ran': []})
		entry['killedBy'] = verdict(mutant.id)
		entry['reachedBy'] = len(tests.reaching.get(mutant.id, []))
		entry['ran'].append(row)
		results['mutants'] = [done[number] for number in sorted(done)]
		write(path, results)
		if not entry['killedBy']:
			say(f'survives {row}: {mutant.file}:{mutant.line} {mutant.original} -> {mutant.mutant}: {mutant.source}')


def parsed():
	parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
	parser.add_argument('--mutants', type=int, default=400, help='how many to pick (400); those that do not compile are taken out')
	parser.add_argument('--seed', type=int, default=1)
	parser.add_argument('--minutes', type=float, default=1e9, help='ends after so long; the same call goes on where it ended')
	parser.add_argument(
		'--only', choices=['core', 'plugin'], help="only mutants of src/ with the core's tests, or only the tests of the plug-in"
	)
	parser.add_argument('--file', action='append', help='picks in files whose names contain this alone; may be repeated')
	parser.add_argument('--id', type=int, action='append', help='only these mutants, anew; may be repeated')
	parser.add_argument(
		'--unit',
		action='append',
		metavar='src/FOLDER/FILE.cpp',
		help="compiles these files alone and links them with the project's own "
		'build of the tests: quick, but a test that instantiates a template by itself has no mutant in it; may be repeated',
	)
	parser.add_argument('--again', action='store_true', help='with the same sources and other tests: those that survived are judged anew')
	parser.add_argument('--tests', nargs='+', metavar='test_NAME.py', default=pluginTests, help='of the plug-in (those about forces)')
	parser.add_argument('--jobs', type=int, default=os.cpu_count(), help='of the compiler')
	parser.add_argument('--output', type=pathlib.Path, default=project / 'output/mutation')
	return parser.parse_args()


def before(path, results):
	"""The results of an earlier call for the same sources and the same choice of mutants, or none."""
	found = json.loads(path.read_text()) if path.exists() else {}
	same = all(found.get(key) == results[key] for key in ('sources', 'seed', 'asked', 'files'))
	return (found['mutants'], found['doNotCompile']) if same else ([], [])


def say(text):
	print(f'{datetime.datetime.now():%H:%M:%S} {text}', flush=True)


def inCore(mutant):
	return mutant.file.startswith('src/')


def main():
	arguments = parsed()
	end = time.monotonic() + 60 * arguments.minutes
	arguments.output = arguments.output.resolve()
	arguments.output.mkdir(parents=True, exist_ok=True)
	path, results = arguments.output / 'results.json', head(arguments)
	results['mutants'], results['doNotCompile'] = before(path, results)
	if arguments.again:
		results['mutants'] = [entry for entry in results['mutants'] if entry['killedBy']]
	if arguments.id:
		results['mutants'] = [entry for entry in results['mutants'] if entry['id'] not in arguments.id]
	some = [
		mutant for mutant in chosen(arguments.mutants, arguments.seed, arguments.file or ['']) if mutant.id not in results['doNotCompile']
	]
	schemata = Schemata(arguments.output, some, say)
	schemata.write()
	schemata.configure()
	schemata.checkSyntax(arguments.jobs)
	order = random.Random(arguments.seed)

	def judge(tests, row, takes):
		results['doNotCompile'] += [mutant.id for mutant in schemata.dropped if mutant.id not in results['doNotCompile']]
		tests.measure(say)
		results['leftOut'] = tests.leftOut
		some = [mutant for mutant in schemata.mutants if takes(mutant) and (not arguments.id or mutant.id in arguments.id)]
		some = order.sample(some, len(some))
		if isinstance(tests, CoreTests):
			judged(some, lambda mutant: tests.verdict(mutant, True), tests, f'{row}, quick', results, path, end, lambda text: None)
			say(f'{row}, quick tests: {sum(not entry["killedBy"] for entry in results["mutants"])} of {len(results["mutants"])} left')
			judged(some, lambda mutant: tests.verdict(mutant, False), tests, row, results, path, end, say)
		else:
			judged(some, tests.verdict, tests, row, results, path, end, say)

	if arguments.unit:
		tests = CoreTests(schemata.link(arguments.jobs, arguments.unit), schemata.key(results['sources']))
		judge(tests, 'units', inCore)
	elif arguments.only != 'plugin':
		schemata.make(arguments.jobs, 'polytope_core_tests')
		judge(CoreTests(schemata.build / 'tests/core/polytope_core_tests', schemata.key(results['sources'])), 'core', inCore)
	if arguments.only != 'core' and not arguments.unit:
		schemata.make(arguments.jobs, 'overlay')
		survivors = {entry['id'] for entry in results['mutants'] if not entry['killedBy']}
		tests = PluginTests(schemata.tree, arguments.tests)
		judge(
			tests,
			'plug-in' if arguments.tests == pluginTests else ' '.join(arguments.tests),
			lambda mutant: not inCore(mutant) or mutant.id in survivors,
		)
	killed = sum(bool(entry['killedBy']) for entry in results['mutants'])
	say(f'{killed} of {len(results["mutants"])} killed; {len(results["doNotCompile"])} did not compile; {path}')


if __name__ == '__main__':
	main()
