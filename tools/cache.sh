# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# The cache folder: whether it is ours, and what in it may be removed. Needs `project`, `cache` and debianRoot.sh.

# The file says that all else in the folder was made by us (and, by the convention of bford.info/cachedir, that backups may
# leave it out).
cacheTag() { echo "$cache/CACHEDIR.TAG"; }
isOurs() { grep -qs 'made by yade-polytope' "$(cacheTag)"; }

# Names of what is in the folder and is not of a kind that earlier versions made, which had no tag but always a lock.
foreignEntries() {
	local entry
	if [ ! -e "$cache/lock" ]; then ls -A "$cache" && return; fi
	for entry in "$cache"/* "$cache"/.[!.]*; do
		[ -e "$entry" ] || continue
		case ${entry##*/} in
			logs | ccache | apt | bench-venv | lock | build.lock | debian13*) ;;
			yade-*) isYadeSource "$entry" || echo "${entry##*/}" ;;
			*) echo "${entry##*/}" ;;
		esac
	done
}

# A source tree that we fetched: YADE's, and not a user's clone.
isYadeSource() {
	case $1 in *.partial) return 0 ;; esac
	[ "$1" != "$project" ] && [ -e "$1/core/Scene.hpp" ] && [ -e "$1/RELEASE" ] && [ ! -e "$1/.git" ]
}

# Makes the folder ours if it is new, empty, or has nothing but what earlier versions made; refuses any other.
claimCache() {
	local foreign
	mkdir -p "$cache"
	isOurs && return
	foreign=$(foreignEntries | head -n 5 | paste -s -d ' ')
	[ -z "$foreign" ] ||
		fail "the cache folder $cache has files that are not yade-polytope's: $foreign" "Name an empty or a new folder: YADE_POLYTOPE_CACHE=… ./run …"
	cat >"$(cacheTag)" <<-TAG
		Signature: 8a477f597d28d172789f06886806bc55
		# This folder was made by yade-polytope. All in it can be made again; ./run clean --all removes it.
	TAG
}

# clean [--root|--all]
clean() {
	local what=${1:-} root result=0
	[ $# -lt 2 ] || fail "clean: takes one option, got '$*'." "They are: --root, --all."
	case $what in
		'' | --root | --all) ;;
		*) fail "clean: there is no option '$what'." "They are: --root, --all." ;;
	esac
	# an earlier version's folder becomes ours; any other is refused before a thing is removed
	if [ -n "$what" ] && [ -d "$cache" ]; then claimCache; fi
	[ "$what" = --root ] || rm -rf "$project/build" "$project/build-without-ipopt"
	{ [ -n "$what" ] && [ -d "$cache" ]; } || return 0
	exec 8>"$cache/lock"
	takeLock 8 set-up
	for root in "$cache"/debian13 "$cache"/debian13Clean "$cache"/debian13-* "$cache"/*.partial; do
		case $root in *.lock | *.made | *.conf) continue ;; esac
		[ ! -d "$root" ] || dropDebianRoot "$root" || result=1
	done
	{ [ "$what" = --all ] && [ $result -eq 0 ]; } || return $result
	for root in "$cache"/yade-*; do
		if isYadeSource "$root"; then rm -rf "$root"; fi
	done
	rm -rf "$cache"/{logs,ccache,apt,bench-venv,build.lock} "$cache"/debian13*.apt.conf
	rm -f "$(cacheTag)" "$cache/lock"
	rmdir --ignore-fail-on-non-empty "$cache"
}
