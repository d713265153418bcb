# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# A Debian 13 root of our own, for machines whose YADE is older or absent; and running a command in it.
#
# For root it is an ordinary chroot, for an ordinary user the same within a user namespace. Either way the mounts are private
# to the command: nothing is left mounted after it. Needs `project` and debian.sh.
# shellcheck disable=SC2154

debianKeyring=/usr/share/keyrings/debian-archive-keyring.gpg

# Runs a command in a namespace where mounts are its own and, for an ordinary user, where it is root over its own files. After `exec` in place of
# this program.
inNamespace() { # [exec] COMMAND ARGS…
	local way=() user=()
	if [ "$1" = exec ]; then way=(exec) && shift; fi
	[ "$(id -u)" -eq 0 ] || user=(--user --map-root-user --map-auto)
	"${way[@]}" unshare "${user[@]}" --mount --propagation private "$@"
}

# What making and entering a root needs; ends the run with the remedy where something is missing.
checkNamespace() {
	inNamespace true 2>/dev/null && return
	if [ "$(id -u)" -eq 0 ]; then
		fail "this machine does not let root have mounts of its own (a container without rights?)." \
			"Use a Debian 13 machine or container: there no root of our own is needed."
	fi
	if ! command -v newuidmap >/dev/null; then
		fail "an ordinary user needs the package uidmap to have a Debian root of his own. Have it installed:" \
			"sudo apt-get install uidmap mmdebstrap"
	fi
	if ! grep -q -E "^($(id -un)|$(id -u)):" /etc/subuid 2>/dev/null; then
		fail "the user $(id -un) has no range of subordinate ids. Have one given:" \
			"sudo usermod --add-subuids 100000-165535 --add-subgids 100000-165535 $(id -un)"
	fi
	fail "this machine does not let ordinary users have user namespaces. One of these, as root:" \
		"sysctl kernel.unprivileged_userns_clone=1" "sysctl kernel.apparmor_restrict_unprivileged_userns=0" \
		"or run \`./run\` as root."
}

# The tools to make a root: installed where we may.
installRootTools() {
	local missing=()
	command -v mmdebstrap >/dev/null || missing+=(mmdebstrap)
	[ -e "$debianKeyring" ] || missing+=(debian-archive-keyring)
	[ ${#missing[@]} -eq 0 ] && return
	command -v apt-get >/dev/null ||
		fail "this machine is neither Debian nor Ubuntu, so no Debian root can be made on it." "Use a container of Debian 13 or newer, and \`./run\` in it."
	[ "$(id -u)" -eq 0 ] || fail "packages are missing to make a Debian 13 root. Have them installed:" "sudo apt-get install ${missing[*]} uidmap"
	step "reading the package lists" "Check apt's sources and the network." apt-get update
	step "installing ${missing[*]}" "Install it by hand." apt-get install -y --no-install-recommends "${missing[@]}"
}

# makeDebianRoot FOLDER MIRROR SECURITY PACKAGE…: made aside and then renamed, so that a folder of this name is always a whole
# root. SECURITY: address of the security archive, or nothing.
makeDebianRoot() {
	local folder=$1 mirror=$2 security=$3 aside=$1.partial signed="deb [signed-by=$debianKeyring]"
	shift 3
	removeDebianRoot "$aside"
	# others cannot look into the folder: the settings of apt, which mmdebstrap writes into the root, may have a password
	mkdir -m 700 "$aside"
	aptWay >"$aside/apt.conf"
	# force-unsafe-io: no waiting for the disk after each file; a root that was not finished is thrown away anyway
	if inNamespace mmdebstrap --mode=root --variant=minbase --include="$(printf '%s\n' "$@" | paste -s -d ,)" \
		--aptopt="$aside/apt.conf" --aptopt='APT::Install-Recommends "false"' --aptopt='APT::Sandbox::User "root"' \
		--dpkgopt=force-unsafe-io \
		trixie "$aside/root" "$signed $mirror trixie main" ${security:+"$signed $security trixie-security main"} &&
		withoutSettings "$aside/root" &&
		date +%s >"$folder.made" && mv "$aside/root" "$folder"; then
		removeDebianRoot "$aside"
	else
		rm -f "$aside/apt.conf"
		removeDebianRoot "$aside"
		return 1
	fi
}

# Replaces the settings that mmdebstrap leaves in the root: no access data of the mirror, and files are written safely again.
withoutSettings() { # ROOT
	# shellcheck disable=SC2016
	inNamespace bash -c '
		printf "%s\n" "APT::Install-Recommends \"false\";" "APT::Sandbox::User \"root\";" >"$0/etc/apt/apt.conf.d/99mmdebstrap"
		rm -f "$0/etc/dpkg/dpkg.cfg.d/99mmdebstrap"' "$1"
}

# An ordinary user's root has files of his subordinate ids; root removes it as it is, within a root like this one, too.
removeDebianRoot() {
	if [ ! -e "$1" ]; then return 0; fi
	if [ "$(id -u)" -eq 0 ]; then rm -rf --one-file-system "$1"; else inNamespace rm -rf --one-file-system "$1"; fi
}

# Held as long as this process and those it starts run in the root $1: file descriptor 7.
holdDebianRoot() {
	exec 7>>"$1.lock"
	flock -s 7
}

# Whether a process runs in the root $1: by the lock, and by the processes whose root it is (older versions took no lock).
debianRootInUse() {
	local process
	for process in /proc/[0-9]*/root; do [ "$(readlink "$process" 2>/dev/null)" != "$1" ] || return 0; done
	[ -e "$1.lock" ] || return 1
	! flock -n -x "$1.lock" true
}

# dropDebianRoot FOLDER: removed, unless a process runs in it
dropDebianRoot() {
	if debianRootInUse "$1"; then
		echo "  $1 is in use, and stays."
		return 1
	fi
	echo "  removing $1 …"
	removeDebianRoot "$1" && rm -f "$1.made" "$1.lock"
}

# installInDebianRoot FOLDER PACKAGE…: into the existing root; processes that run in it are not affected
installInDebianRoot() {
	# in the environment: a command line is visible to every user
	APT_WAY=$(aptWay) inNamespace bash "$project/tools/installInRoot.sh" "$@"
}

# inDebianRoot FOLDER COMMAND ARGS…: in the same working folder, with the same paths, and in place of this program, so that a signal reaches the command
inDebianRoot() { inNamespace exec bash "$project/tools/enterRoot.sh" "$@"; }
