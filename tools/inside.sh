#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# inside.sh COMMAND ARGS…: what `run` does where YADE is: configure, build, and run things with the plug-in.
# Needs from `run`: project, cache, logs, yadeSource, buildKey.
# shellcheck disable=SC2154
set -euo pipefail
# shellcheck source=tools/messages.sh
. "$project/tools/messages.sh"

build=$project/build
yadeLibrary=$(echo /usr/lib/*/yade-double)
export CCACHE_DIR=${CCACHE_DIR:-$cache/ccache}
# a second clone of the project finds what the first one compiled
export CCACHE_BASEDIR=$project CCACHE_NOHASHDIR=1
export YADE_PREFIX=$build/overlay
export PYTHONPATH=$yadeLibrary/py
# YADE is built with MPI, which refuses to run as root unless told
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# The build folder belongs to one YADE and one place: with another one it is made anew.
configure() {
	[ -e "$build/build.ninja" ] && [ "$(cat "$build/key" 2>/dev/null)" = "$buildKey" ] && return
	rm -rf "$build"
	mkdir -p "$build"
	step "configuring" "tools/packages.txt lists what is needed." \
		cmake -S "$project" -B "$build" -G Ninja -DPOLYTOPE_YADE=ON -DYADE_SOURCE_DIR="$yadeSource"
	echo "$buildKey" >"$build/key"
}

build() {
	(
		flock 9 # two calls at a time build one after the other
		configure
		step "building" "All messages of the compiler are in the log." ninja -C "$build" "$@"
	) 9>"$cache/build.lock"
}

# Tests of the core, then of the plug-in; both run whatever the first says.
runTests() {
	local result=0
	echo
	ctest --test-dir "$build" --output-on-failure -j "$(nproc)" || result=1
	echo
	# `pytest` as a program: `python3 -m pytest` would put the project's folder first, and its py/ hides the module `py`
	(cd "$project" && pytest tests/yade "$@") || result=1
	return $result
}

format() {
	local check=() files
	[ "${1:-}" = --check ] && check=(--dry-run --Werror)
	cd "$project"
	mapfile -t files < <(find src pkg tests -name '*.cpp' -o -name '*.hpp')
	clang-format -i "${check[@]}" "${files[@]}"
	if command -v ruff >/dev/null; then
		if [ "${1:-}" = --check ]; then ruff format --check . && ruff check .; else ruff format . && ruff check --fix .; fi
	fi
}

command=$1
shift
case $command in
	build) build "$@" ;;
	test) build && runTests "$@" ;;
	yade) build && exec yade "$@" ;;
	python) build && exec python3 "$@" ;;
	bench) build && . "$project/tools/bench.sh" && benchmark "$@" ;;
	shell) build && exec bash "$@" ;;
	format) format "$@" ;;
	*) fail "inside.sh: no command $command" ;;
esac
