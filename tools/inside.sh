#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# inside.sh COMMAND ARGS…: what `run` does where YADE is: configure, build, and run things with the plug-in.
# Needs from `run`: project, cache, logs, yadeSource, buildKey; YADE_POLYTOPE_PRECISION may be set.
# shellcheck disable=SC2154
set -euo pipefail
# shellcheck source=tools/messages.sh
. "$project/tools/messages.sh"
# shellcheck source=tools/verbs.sh
. "$project/tools/verbs.sh"

build=$project/build # of double; those of the other precisions are in it
ipopt=AUTO
if [ "${YADE_POLYTOPE_IPOPT:-}" = OFF ]; then build=$project/build-without-ipopt && ipopt=OFF; fi
widePrecisions="longdouble float128 mpfr150"
measuringPrograms="accuracy/polytope_extremes search/polytope_search" # that tests and reports run
export CCACHE_DIR=${CCACHE_DIR:-$cache/ccache}
# a second clone of the project reuses what the first one compiled
export CCACHE_BASEDIR=$project CCACHE_NOHASHDIR=1
export YADE_PREFIX=$build/overlay # of all precisions
cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc) # nproc takes OMP_NUM_THREADS for the number of cores
# One thread unless asked for, as the program `yade` does: with few bodies, threads wait for each other longer than they work
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
# YADE is built with MPI, which refuses to run as root unless told. What is set in the environment stays
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# shared memory alone: Open MPI looks for a network interface otherwise, and waits for ever where there is none
export OMPI_MCA_btl=${OMPI_MCA_btl:-self,sm}
# processes that wait leave the cores to the others: there may be more processes than cores
export OMPI_MCA_mpi_yield_when_idle=${OMPI_MCA_mpi_yield_when_idle:-1}

hasPrecision() { compgen -G "/usr/lib/*/yade-$1/py/yade" >/dev/null; }

# From here on Python, pytest and `yadeProgram` are those of this precision of YADE (double, longdouble, float128, mpfr150).
usePrecision() { # PRECISION
	hasPrecision "$1" ||
		fail "no YADE of the precision '$1' is installed here." "Debian's package yade has double, longdouble, float128 and mpfr150."
	precision=$1
	PYTHONPATH=$(echo /usr/lib/*/"yade-$1/py")
	export PYTHONPATH
	yadeProgram=yade
	[ "$precision" = double ] || yadeProgram=yade-$precision
}

# The build folder belongs to one YADE and one path: for another one it is made again.
configure() { # FOLDER PRECISION
	local entry options=()
	[ -e "$1/build.ninja" ] && [ "$(cat "$1/key" 2>/dev/null)" = "$buildKey" ] && return
	# the core's own tests are about double
	[ "$2" = double ] || options=(-DPOLYTOPE_TESTS=OFF)
	mkdir -p "$1"
	for entry in "$1"/* "$1"/.[!.]*; do
		case " $widePrecisions overlay " in *" ${entry##*/} "*) ;; *) rm -rf "$entry" ;; esac # double's folder holds the others'
	done
	step "configuring" "tools/packages.txt lists what is needed." \
		cmake -S "$project" -B "$1" -G Ninja -DPOLYTOPE_YADE=ON -DPOLYTOPE_PRECISION="$2" -DPOLYTOPE_OVERLAY="$build/overlay" \
		-DPOLYTOPE_IPOPT="$ipopt" -DYADE_SOURCE_DIR="$yadeSource" "${options[@]}"
	echo "$buildKey" >"$1/key"
}

# Whether the plug-in is compiled file by file, with -O1 (docs/developing.md): for commands that measure nothing.
developing() {
	[ "${YADE_POLYTOPE_DEVELOP:-}" = 1 ] || return
	case $command in build | test | yade | python | shell) ;; *) return 1 ;; esac
}

# The build folder for that, or for use: what was compiled for the other stays in it.
setDevelop() { # FOLDER
	local develop=OFF
	if developing; then develop=ON; fi
	grep -qx "POLYTOPE_DEVELOP:BOOL=$develop" "$1/CMakeCache.txt" || step "configuring" "tools/packages.txt lists what is needed." cmake -DPOLYTOPE_DEVELOP="$develop" "$1"
}

buildFolder() { [ "$1" = double ] && echo "$build" || echo "$build/$1"; } # PRECISION

# One number for all that the plug-in, or with `tests` its test programs, are compiled from.
sourcesKey() { # [tests]
	local folders=(src pkg cmake CMakeLists.txt)
	[ $# -eq 0 ] || folders+=(tests tools/measure)
	{
		echo "$buildKey"
		cd "$project" && find "${folders[@]}" -type f -regex '.*\.\([ch]pp\|txt\|in\|cmake\|py\)' ! -path 'tests/*.py' ! -path 'tools/*.py' -print0 | sort -z | xargs -0 sha256sum
	} | sha256sum
}

# Removes what was built from other sources than the present ones: no test or report may use it in their place.
dropStale() {
	local name folder key
	[ -d "$build" ] || return 0 # nothing was built
	key=$(sourcesKey)
	for name in double $widePrecisions; do
		folder=$(buildFolder "$name")
		[ "$name" != "$precision" ] && [ -e "$folder/overlay.complete" ] && [ "$(cat "$folder/sources" 2>/dev/null)" != "$key" ] || continue
		find "$build/overlay" -maxdepth 3 -name "yade-$name" -exec rm -rf {} +
		rm -f "$folder/overlay.complete"
		echo "  $name: built from other sources than the present ones; not used until it is built again"
	done
	key=$(sourcesKey tests)
	for name in $measuringPrograms; do
		[ "$(cat "$build/tools/measure/$name.sources" 2>/dev/null)" = "$key" ] || rm -f "$build/tools/measure/$name"
	done
}

# Builds one precision, whichever is in use.
buildPrecision() { # PRECISION TARGETS…
	local folder name=$1 of= program
	shift
	folder=$(buildFolder "$name")
	[ "$name" = double ] || of=" for $name"
	(
		takeLock 9 build # two calls at a time build one after the other
		configure "$folder" "$name"
		setDevelop "$folder"
		case " $* " in *" overlay "*) rm -f "$folder/sources" ;; esac
		step "building$of" "All messages of the compiler are in the log." ninja -C "$folder" "$@"
		case " $* " in *" overlay "*) sourcesKey >"$folder/sources" ;; esac
		for program in $measuringPrograms; do
			case " $* " in *" testPrograms "* | *" ${program#*/} "*) sourcesKey tests >"$build/tools/measure/$program.sources" ;; esac
		done
	) 9>"$cache/build.lock"
}

# The plug-in of the precision in use, unless targets are named.
build() { # [TARGETS…]
	[ $# -gt 0 ] || set -- overlay
	(takeLock 9 build && dropStale) 9>"$cache/build.lock"
	buildPrecision "$precision" "$@"
}

# A program of the core's, in double whatever the precision in use is, and the plug-in.
buildWith() { # TARGET
	if [ "$precision" = double ]; then build overlay "$1"; else build && buildPrecision double "$1"; fi
}

# Random pairs against exact arithmetic; a log beside what it prints.
search() {
	local logFile
	logFile=$project/output/search/log-$(date -u +%Y%m%d-%H%M%S).txt
	mkdir -p "$project/output/search"
	POLYTOPE_REVISION=$(git -c safe.directory="$project" -C "$project" describe --always --exclude='*' --abbrev=40 --dirty 2>/dev/null || true) \
		"$build/tools/measure/search/polytope_search" --log "$logFile" "$@"
}

# The full run uses every precision that its scenes name and that is installed; the quick one those that are already built.
tradeoff() {
	local script=$project/tools/measure/tradeoff.py said other needed
	# options first: a mistake, or --help, is answered before anything is built
	said=$(python3 "$script" --check "$@") || exit
	[ -z "$said" ] || { echo "$said" && exit; }
	build
	needed=$(python3 "$script" --precisions "$@") || exit
	for other in $widePrecisions; do
		if grep -qx "$other" <<<"$needed" && hasPrecision "$other"; then
			(buildPrecision "$other" overlay) || echo "  $other: its rows say that it was not built"
		fi
	done
	exec python3 "$script" "$@"
}

# A script on several processes of this machine, more than it has cores if asked for.
mpi() { # N SCRIPT [ARGUMENTS…]
	[[ ${1:-} =~ ^[1-9][0-9]{0,3}$ ]] || fail "mpi: the first argument must be the number of processes, from 1 to 9999, not '${1:-}'." "./run mpi 3 examples/mpi.py"
	[ -f "${2:-}" ] || fail "mpi: the second argument must be a script; there is no file '${2:-}'." "./run mpi 3 examples/mpi.py"
	[ "$precision" = double ] || fail "mpi: YADE's $precision is built without MPI." "Leave YADE_POLYTOPE_PRECISION away."
	command -v mpirun >/dev/null || fail "mpi: there is no mpirun here." "Install Debian's package openmpi-bin."
	build
	exec mpirun --oversubscribe -np "$1" "$yadeProgram" -n -x "${@:2}"
}

format() {
	local check=() files
	[ "${1:-}" = --check ] && check=(--dry-run --Werror)
	cd "$project"
	mapfile -t files < <(find src pkg tests tools -name '*.cpp' -o -name '*.hpp')
	clang-format -i "${check[@]}" "${files[@]}"
	if command -v ruff >/dev/null; then
		if [ "${1:-}" = --check ]; then ruff format --check . && ruff check .; else ruff format . && ruff check --fix .; fi
	fi
}

command=$1
shift
usePrecision "${YADE_POLYTOPE_PRECISION:-double}"
case $command in
	build) build "$@" ;;
	test) . "$project/tools/test.sh" && test_ "$@" ;;
	yade) build && exec "$yadeProgram" "$@" ;;
	python) build && exec python3 "$@" ;;
	mpi) mpi "$@" ;;
	tradeoff) tradeoff "$@" ;;
	search) buildPrecision double polytope_search && search "$@" ;;
	accuracy) buildWith polytope_extremes && exec python3 "$project/tools/measure/accuracy/report.py" "$@" ;;
	paper) build && exec python3 "$project/examples/paper/report.py" "$@" ;;
	docs) build && exec python3 "$project/tools/site/build.py" "$@" ;;
	figures) . "$project/tools/figures.sh" && figures "$@" ;;
	bench) . "$project/tools/bench.sh" && benchmark "$@" ;;
	fuzz) . "$project/tools/fuzz.sh" && fuzz "$@" ;; # the core alone, in a folder of its own
	sanitize) . "$project/tools/fuzz.sh" && sanitize "$@" ;;
	shell) build && exec bash "$@" ;;
	package) . "$project/tools/package.sh" && buildPackage "$@" ;;
	format) format "$@" ;;
	*) fail "inside.sh: no command $command" ;;
esac
