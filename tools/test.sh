# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run test`. Part of inside.sh.

results=$build/test-results # a JUnit file for each part; tools/skipped.py reads what was skipped from them
fast=
nativeTrace=$build/tests/core/libpolytope_native_trace.so
places=() # what pytest runs, all where it is empty; rooms are folders of tests/yade
core=yes  # whether ctest runs

# Tests of the core (in double alone), then of the plug-in; both run whatever the result of the first.
runTests() {
	local result=0
	if [ "$precision" = double ] && [ -n "$core" ]; then
		echo
		rm -f "$results/core.xml"
		ctest --test-dir "$build" --output-on-failure -j "$cores" --output-junit "$results/core.xml" ${fast:+-LE slow} || result=1
	fi
	echo
	[ ${#places[@]} = 0 ] && [ -n "$onlyCore" ] || runPytest "$@" || result=1
	return $result
}

# In one process more than there are cores, since tests wait for processes that they start and for O.run, which YADE looks at every 40 ms; unless
# the arguments say how many or ask for a debugger.
runPytest() {
	local options=() folders=(tests/yade) argument parallel=yes
	[ "$precision" != double ] || folders+=(tests/tools)
	[ ${#places[@]} = 0 ] || folders=("${places[@]}")
	for argument in "$@"; do
		case $argument in -n | -n[0-9]* | --numprocesses* | --dist* | --pdb | --trace | no:xdist) parallel='' ;; esac
	done
	# worksteal: tests of one file stay in one process, which makes their scenes once, until the other process has nothing left
	[ -z "$parallel" ] || options=(-n "$((cores + 1))" --dist worksteal)
	[ -z "$fast" ] || options+=(-m "not slow")
	rm -f "$results/$precision.xml"
	# `pytest` as a program: `python3 -m pytest` would put the project's folder first, and its py/ hides the module `py`
	(cd "$project" && LD_PRELOAD=$nativeTrace pytest "${folders[@]}" --junitxml="$results/$precision.xml" "${options[@]}" "$@")
}

# All tests in double, then in long double those that tests/yade/conftest.py names for wider precisions.
testAll() {
	local result=0 status
	buildTests
	if [ -z "$fast$onlyPlaces" ] && hasPrecision longdouble; then buildPrecision longdouble overlay; fi # now, since tests in double use it, too
	runTests "$@" || result=1
	if [ -z "$fast$onlyPlaces" ] && hasPrecision longdouble; then
		echo
		usePrecision longdouble
		echo "long double:"
		status=0
		runPytest "$@" || status=$?
		[ $status -eq 0 ] || [ $status -eq 5 ] || result=1 # 5: these arguments select none of them
	fi
	return $result
}

# What the tests of this precision need.
buildTests() {
	if [ "$precision" = double ] && [ -n "$core" ]; then
		build overlay testPrograms
	else
		buildWith polytope_native_trace
	fi
}

# test [--fast] [PLACE…] OPTIONS OF PYTEST…
test_() {
	local result=0 expected=() onlyPlaces='' onlyCore='' place
	if [ "${1:-}" = --fast ]; then fast=yes && shift; fi
	while [ $# -gt 0 ] && [[ $1 != -* ]]; do
		[ -n "$onlyPlaces" ] || core=''
		onlyPlaces=yes place=$(placeOf "$1") || exit
		if [ "$place" = core ]; then core=yes onlyCore=yes; else places+=("$place"); fi
		shift
	done
	# pytest looks at its options first: nothing is built for a wrong one
	(cd "$project" && pytest --version "$@" >/dev/null) || return
	mkdir -p "$results"
	rm -f "$results"/*.xml
	if [ -n "${YADE_POLYTOPE_PRECISION:-}" ]; then
		buildTests
		runTests "$@" || result=1
	else
		testAll "$@" || result=1
		[ -n "$fast$onlyPlaces" ] || expected=(--expect-precision longdouble)
	fi
	[ "$fast$onlyPlaces${YADE_POLYTOPE_PRECISION:-double}" != double ] || expected+=(--expect-core)
	echo
	[ -z "$fast" ] || echo "--fast: tests marked slow, tests of the core with the label slow, and the repeat in long double were left out"
	python3 "$project/tools/skipped.py" "${expected[@]}" "$results" || result=1
	return $result
}
