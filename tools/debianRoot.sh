# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# A Debian 13 root of our own, for machines whose YADE is older or absent; and running a command in it.
#
# As root it is an ordinary chroot, as an ordinary user the same within a user namespace. Either way the mounts are
# private to the command: nothing is left mounted after it. Needs `project`.
# shellcheck disable=SC2154

debianKeyring=/usr/share/keyrings/debian-archive-keyring.gpg

# Runs a command in a namespace where mounts are its own and, for an ordinary user, where it is root over its own files.
inNamespace() {
	if [ "$(id -u)" -eq 0 ]; then
		unshare --mount --propagation private "$@"
	else
		unshare --user --map-root-user --map-auto --mount --propagation private "$@"
	fi
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

# makeDebianRoot FOLDER MIRROR: made aside and then renamed, so that a folder of this name is always a whole root
makeDebianRoot() {
	local folder=$1 mirror=$2 work=$1.partial
	removeDebianRoot "$work"
	mkdir -p "$work"
	# force-unsafe-io: no waiting for the disk after each file; a root that was not finished is thrown away anyway
	# the machine's own way to its mirror: proxies and certificates
	apt-config dump | grep -E '^Acquire::(Retries|https?)(::|[[:space:]])' >"$folder.apt.conf" || true
	inNamespace mmdebstrap --mode=root --variant=minbase --include="$(packages | paste -s -d ,)" \
		--aptopt="$folder.apt.conf" --aptopt='APT::Install-Recommends "false"' --aptopt='APT::Sandbox::User "root"' \
		--dpkgopt=force-unsafe-io \
		trixie "$work" "deb [signed-by=$debianKeyring] $mirror trixie main" &&
		mv "$work" "$folder" && rm -f "$folder.apt.conf"
}

removeDebianRoot() { [ ! -e "$1" ] || inNamespace rm -rf --one-file-system "$1"; }

# inDebianRoot FOLDER COMMAND ARGS…: in the same working folder, with the same paths
inDebianRoot() { inNamespace bash "$project/tools/enterRoot.sh" "$@"; }
