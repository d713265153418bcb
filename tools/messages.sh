# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# What the user sees: long steps with their time, failures with reason and remedy. Needs `logs`, a folder.

fail() { # TEXT…: ends the run
	printf '\n%s\n' "yade-polytope: $1" >&2
	shift
	for line in "$@"; do printf '  %s\n' "$line" >&2; done
	exit 1
}

# step NAME REMEDY COMMAND ARGS…
# Runs the command with its output in a log file. One line: the name, and the time it took.
step() {
	local name=$1 remedy=$2 log start pid result=0
	shift 2
	# shellcheck disable=SC2154
	log=$logs/${name//[^A-Za-z0-9]/-}.log
	mkdir -p "$logs"
	start=$SECONDS
	# a process group of its own, so that an interruption ends all of it
	set -m
	"$@" >"$log" 2>&1 </dev/null &
	pid=$!
	set +m
	# shellcheck disable=SC2064
	trap "kill -TERM -- -$pid 2>/dev/null; wait $pid 2>/dev/null; echo; exit 130" INT TERM
	if [ -t 1 ]; then
		while kill -0 "$pid" 2>/dev/null; do
			printf '\r  %s … %d:%02d ' "$name" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60))
			sleep 1
		done
		printf '\r'
	else
		printf '  %s …\n' "$name"
	fi
	wait "$pid" || result=$?
	trap - INT TERM
	if [ "$result" -ne 0 ]; then
		printf '  %s: failed after %d:%02d; the last lines of its log:\n\n' "$name" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60)) >&2
		tail -n 20 "$log" | sed 's/^/    /' >&2
		fail "the step '$name' failed." "Log: $log" "$remedy"
	fi
	printf '  %s: done in %d:%02d \n' "$name" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60))
}
