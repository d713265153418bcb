# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Queries of this machine's package system. Needs `project` and `cache`.
# shellcheck disable=SC2154

# The packages of these purposes, each once.
packages() { # PURPOSE…
	local purpose
	for purpose in "$@"; do grep -q "^\[$purpose\]" "$project/tools/packages.txt" || fail "tools/packages.txt has no purpose '$purpose'."; done
	awk -v wanted=" $* " '
		{ sub(/#.*/, ""); gsub(/[[:space:]]/, "") }
		/^\[.*\]$/ { purpose = substr($0, 2, length($0) - 2); next }
		$0 && index(wanted, " " purpose " ") && !seen[$0]++' "$project/tools/packages.txt"
}

# Prints those of the packages on standard input that are not installed, in the root folder $1 (default /).
missingPackages() {
	local installed
	installed=" $(dpkg-query --admindir="${1:-}/var/lib/dpkg" -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null | sed -n 's/^installed //p' | tr '\n' ' ') "
	while read -r package; do case $installed in *" $package "*) ;; *) echo "$package" ;; esac done
}

# Version of the installed package $1, in the root folder $2 (default /); fails if it is not installed.
installedVersion() {
	local status
	status=$(dpkg-query --admindir="${2:-}/var/lib/dpkg" -W -f '${db:Status-Status} ${Version}' "$1" 2>/dev/null) || return 1
	[[ $status == installed\ * ]] && echo "${status#installed }"
}

recentYade() { [ -n "${1:-}" ] && dpkg --compare-versions "$1" ge 2025; } # the oldest version whose features are supported

# Debian's testing and unstable have no VERSION_ID
osRelease() { sed -n "s/^$1=//p" /etc/os-release | tr -d '"' | grep . || { [ "$1" = VERSION_ID ] && echo 99; }; }

# Can this machine be used as it is?
hasRecentYade() {
	[ "${YADE_POLYTOPE_OWN_ROOT:-0}" = 1 ] && return 1
	command -v dpkg-query apt-cache >/dev/null || return 1
	recentYade "$(installedVersion yade)" && return 0
	[ ! -d "$cache/debian13" ] || return 1 # a root was made here: as before, and apt need not be asked
	local candidate
	candidate=$(LC_ALL=C apt-cache policy yade 2>/dev/null | sed -n 's/^  Candidate: //p')
	if [ -z "$candidate" ] || [ "$candidate" = "(none)" ]; then
		# no package lists yet, as in a fresh container
		[ "$(osRelease ID)" = debian ] && dpkg --compare-versions "$(osRelease VERSION_ID)" ge 13
		return
	fi
	recentYade "$candidate"
}

installMissingPackages() { # PURPOSE…
	local missing
	mapfile -t missing < <(packages "$@" | missingPackages)
	[ ${#missing[@]} -eq 0 ] && return
	local line="apt-get install --no-install-recommends ${missing[*]}"
	if [ "$(id -u)" -ne 0 ]; then
		fail "${#missing[@]} packages are missing on this machine. Have them installed:" "sudo $line" \
			"or let yade-polytope make a Debian root of its own: YADE_POLYTOPE_OWN_ROOT=1 ./run …"
	fi
	cat <<-TEXT
		  You are root, and this machine has a YADE that fits: ${#missing[@]} packages are installed on the machine itself, from its archives:
		    ${missing[*]}
		  To leave the machine as it is, interrupt and let yade-polytope make a Debian root of its own: YADE_POLYTOPE_OWN_ROOT=1 ./run …
	TEXT
	step "reading the package lists" "Check apt's sources and the network." apt-get update
	# shellcheck disable=SC2086
	DEBIAN_FRONTEND=noninteractive step "installing ${#missing[@]} packages on this machine" "Try by hand: $line" ${line/install/install -y}
}

# The archives of the distribution $1 with the label $2 that apt has here: a line "URI SUITE COMPONENT" each. apt itself reads its source
# files, in whatever format. Without package lists it cannot tell whose an archive is: then they are read into a folder of
# our own.
archivesOf() {
	# shellcheck disable=SC2016
	local lists=() format='$(ORIGIN)|$(LABEL)|$(REPO_URI)|$(RELEASE)|$(COMPONENT)'
	command -v apt-get >/dev/null || return 0
	if [ -z "$(apt-get indextargets 2>/dev/null)" ]; then
		mkdir -p "$cache/apt/lists/partial"
		lists=(-o "Dir::State::lists=$cache/apt/lists" -o "APT::Sandbox::User=$(id -un)")
		apt-get "${lists[@]}" update >/dev/null 2>&1 || true
	fi
	apt-get "${lists[@]}" indextargets --format "$format" 'Created-By: Packages' | sed -n "s/^$1|$2|//Ip" | tr '|' ' ' | sort -u
}
ownArchives() { archivesOf "$(osRelease ID)" "$(osRelease ID)"; }

# The address Debian 13 is fetched from.
debianMirror() {
	if [ -n "${YADE_POLYTOPE_MIRROR:-}" ]; then
		echo "$YADE_POLYTOPE_MIRROR"
	else
		archivesOf Debian Debian | cut -d ' ' -f 1 | head -n 1
	fi
}

# Whether the archive at this address has the suite, and answers.
reachable() { # MIRROR SUITE
	local file result=0
	file=$(mktemp)
	/usr/lib/apt/apt-helper -o "APT::Sandbox::User=$(id -un)" download-file "${1%/}/dists/$2/InRelease" "$file" >/dev/null 2>&1 || result=1
	rm -f "$file"
	return $result
}

# The address of Debian's security archive that goes with the mirror $1; nothing where it cannot be reached.
securityMirror() {
	local candidate
	for candidate in "${YADE_POLYTOPE_SECURITY:-}" "$(archivesOf Debian Debian-Security | cut -d ' ' -f 1 | head -n 1)" \
		"$(sed -E 's,/debian/*$,/debian-security/,; t; d' <<<"$1")"; do
		if [ -n "$candidate" ] && reachable "$candidate" trixie-security; then echo "$candidate" && break; fi
	done
}

# The machine's own access to its mirror, as lines of an apt.conf: proxies (perhaps with a password) and certificates.
aptWay() { apt-config dump | grep -E '^Acquire::(Retries|https?)(::|[[:space:]])' || true; }
