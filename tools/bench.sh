# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run bench`: builds the comparators in a folder of their own, so that the ordinary build stays as it is, and measures.
# Part of inside.sh.

# coal comes from PyPI, in the versions of coal.txt; without it the benchmark goes on.
coalPrefix() {
	local venv=$cache/bench-venv wanted=$project/tools/coal.txt
	if ! cmp -s "$venv/complete" "$wanted"; then
		rm -rf "$venv"
		(step "fetching coal from PyPI" "The benchmark goes on without it." installCoal "$venv" "$wanted") >&2 || return 0
	fi
	echo "$venv"/lib/python3*/site-packages/cmeel.prefix
}

installCoal() { # FOLDER REQUIREMENTS
	python3 -m venv "$1" &&
		"$1/bin/pip" install --disable-pip-version-check --only-binary :all: --require-hashes -r "$2" && cp "$2" "$1/complete"
}

benchmark() {
	local programs=$build/bench coal said
	# options first: nothing is built for a wrong one, nor for --help
	said=$(python3 "$project/tools/measure/benchmark/bench.py" --programs "$programs" "$@" --check) || exit
	[ -z "$said" ] || { echo "$said" && exit; }
	build
	coal=$(coalPrefix)
	(
		takeLock 9 build
		step "configuring the benchmark" "tools/packages.txt lists what is needed." \
			cmake -S "$project" -B "$programs" -G Ninja -DPOLYTOPE_BENCHMARK=ON -DPOLYTOPE_TESTS=OFF -DPOLYTOPE_YADE=ON \
			-DYADE_SOURCE_DIR="$yadeSource" -DPOLYTOPE_COAL_PREFIX="$coal"
		step "building the benchmark" "All messages of the compiler are in the log." ninja -C "$programs" polytope_benchmark
		# one that cannot be built is named in the results; each compiler process takes up to 3 GB
		case " $* " in
			*" --beside"* | *" --only kernels "* | *" --only=kernels "* | *" --only threads "* | *" --only=threads "* | *" --only shapes "* | *" --only=shapes "* | \
				*" --only results "* | *" --only=results "* | *" --only sizes "* | *" --only=sizes "* | *" --only scale "* | *" --only=scale "*) ;;
			*) (step "building YADE's PotentialBlock and Polyhedra" "The benchmark goes on without." ninja -j 2 -k 0 -C "$programs" yadePeers) || true ;;
		esac
	) 9>"$cache/build.lock"
	exec python3 "$project/tools/measure/benchmark/bench.py" --programs "$programs/tools/measure/benchmark" "$@"
}
