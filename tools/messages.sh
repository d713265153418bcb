# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Output for the user: long steps with their time, failures with reason and remedy. Needs `logs`, a folder.

fail() { # TEXT…: ends the run
	printf '\n%s\n' "yade-polytope: $1" >&2
	shift
	for line in "$@"; do printf '  %s\n' "$line" >&2; done
	exit 1
}

# Takes the lock on this file descriptor; where another call has it, says what is waited for.
takeLock() { # DESCRIPTOR WHAT
	flock -n "$1" || { echo "  waiting for another ./run to end its $2 …" && flock "$1"; }
}

# step NAME REMEDY COMMAND ARGS…
# Runs the command with its output in a log file. Shows the name and the time it takes; nothing if that is under 2 s.
step() {
	local name=$1 remedy=$2 log start pid shown='' result=0
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
	while kill -0 "$pid" 2>/dev/null; do
		if [ $((SECONDS - start)) -ge 2 ]; then
			if [ -t 1 ]; then
				printf '\r  %s … %s ' "$name" "$(elapsed "$start")"
			elif [ -z "$shown" ]; then
				printf '  %s …\n' "$name"
			fi
			shown=yes
			sleep 1
		else
			sleep 0.05
		fi
	done
	wait "$pid" || result=$?
	trap - INT TERM
	if [ -n "$shown" ] && [ -t 1 ]; then printf '\r'; fi
	if [ "$result" -ne 0 ]; then
		printf '  %s: failed after %s; the last lines of its log:\n\n' "$name" "$(elapsed "$start")" >&2
		tail -n 20 "$log" | cut -c 1-300 | sed 's/^/    /' >&2
		fail "the step '$name' failed." "Log: $log" "$remedy"
	fi
	if [ -n "$shown" ]; then printf '  %s: done in %s \n' "$name" "$(elapsed "$start")"; fi
}

elapsed() { printf '%d:%02d' $(((SECONDS - $1) / 60)) $(((SECONDS - $1) % 60)); }
