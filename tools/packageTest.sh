# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run package --test`: installs the package in a clean Debian 13 root, as a user does, tries it there, and removes it. Part of `run`.

# package [--ipopt] [--test]
package() {
	local argument kind=() name=yade-polytope try='' why=''
	for argument in "$@"; do
		case $argument in --ipopt) kind=(--ipopt) name=yade-polytope-ipopt ;; --test) try=yes ;; esac
	done
	if [ -n "$try" ]; then claimCache && why=$(whyNoCleanRoot "$(debianMirror)"); fi
	if [ -n "$why" ]; then
		echo "yade-polytope: the package cannot be tried here, so none was made: $why." "Without --test it is only made."
		return
	fi
	(inside package "${kind[@]}")
	[ -z "$try" ] || testPackage "$name"
}

# Why no package can be installed in a root here; nothing if one can.
whyNoCleanRoot() { # MIRROR
	if ! command -v mmdebstrap >/dev/null && [ "$(id -u)" -ne 0 ]; then
		echo "mmdebstrap is not installed"
	elif ! inNamespace true 2>/dev/null; then
		echo "this machine does not allow namespaces, which a Debian root needs"
	elif [ -z "$1" ] || ! reachable "$1" trixie; then
		echo "no mirror of Debian can be reached; YADE_POLYTOPE_MIRROR=http://… names one"
	fi
}

# The smallest Debian 13, of which each test gets a copy.
setUpCleanRoot() { # MIRROR
	clean=$cache/debian13Clean
	exec 8>"$cache/lock"
	takeLock 8 set-up
	if [ ! -d "$clean" ]; then
		installRootTools
		step "making a clean Debian 13 root" "Check the network and the mirror ($1); then call again." makeDebianRoot "$clean" "$1" "$(securityMirror "$1")" apt
	fi
	holdDebianRoot "$clean"
	exec 8>&-
}

# In the copy, with apt's way to the mirror, which is no command line's to show.
inCopy() { APT_WAY=$(aptWay) inNamespace bash "$project/tools/aptInRoot.sh" "$copy" "$@"; } # COMMAND ARGUMENTS…

# The file of a package in the copy.
inTry() { basename "$(compgen -G "$project/output/package/$1"_*.deb)" | sed "s#^#$try/#"; } # NAME

testPackage() { # NAME
	local try=/root/try
	setUpCleanRoot "$(debianMirror)"
	copy=$(mktemp -d --suffix=.partial "$cache/debian13Package-XXXXXX")
	trap 'removeDebianRoot "$copy"' EXIT
	step "copying the clean root" "Is there room on the disk?" inNamespace cp -a --reflink=auto "$clean/." "$copy"
	inNamespace mkdir "$copy$try"
	inNamespace cp "$project"/output/package/*.deb "$project/debian/tests/first-scene" "$project/tests/package/inRoot.sh" "$project/tools/site/links.py" "$copy$try"
	step "reading the package lists" "Check the network; then call again." inCopy apt-get update
	local install=(inCopy apt-get install -y --no-install-recommends -o Dpkg::Options::=--force-unsafe-io) # unsafe: the copy is thrown away
	step "apt install of $1 with YADE" "Does the mirror have the very YADE that the package was built for?" "${install[@]}" "$(inTry "$1")"
	step "the installed package at work" "debian/tests/first-scene says what is tried." inCopy bash $try/first-scene
	if [ "$1" = yade-polytope ]; then
		step "apt install of its documentation" "Call again." "${install[@]}" "$(inTry "$1-doc")"
		step "the installed documentation, and its removal" "tests/package/inRoot.sh says what is tried." inCopy bash $try/inRoot.sh documentation "$1-doc"
	fi
	step "the installed package beside another YADE" "tests/package/inRoot.sh says what is tried." inCopy bash $try/inRoot.sh otherYade "$1"
	step "removing the package" "tests/package/inRoot.sh says what may be left." inCopy bash $try/inRoot.sh remove "$1"
	step "apt install of $1 where YADE is" "Call again." "${install[@]}" "$(inTry "$1")"
	if [ "$1" = yade-polytope ]; then
		# last: it brings compilers
		step "apt install of its headers and library" "Call again." "${install[@]}" cmake g++ "$(inTry "$1-dev")" "$(inTry 'libpolytope-core*')"
		step "programs and extensions with them, and their removal" "tests/package/inRoot.sh says what is tried." inCopy bash $try/inRoot.sh headers "$1-dev"
	fi
	echo "  $1: installed, tried and removed in a clean Debian 13 root"
}
