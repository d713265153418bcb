# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# YADE's source tree: the headers to compile against. YADE has no package of headers, but its source package has them.
# The tree is that of exactly the installed version, fetched with the machine's apt under settings of our own: nothing in the
# system changes and no rights are needed. Needs `root`.
# shellcheck disable=SC2154

# fetchYadeSource FOLDER VERSION ARCHIVE…: unpacks into FOLDER; an archive is a line "URI SUITE COMPONENT"
fetchYadeSource() {
	local folder=$1 version=$2 work=$1.partial keyring signed='' archive
	shift 2
	rm -rf "$work"
	mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/tree"
	if [ -n "$root" ]; then keyring=$debianKeyring; else keyring=/usr/share/keyrings/$(osRelease ID)-archive-keyring.gpg; fi
	[ -e "$keyring" ] && signed="[signed-by=$keyring] "
	for archive in "$@"; do echo "deb-src $signed$archive"; done >"$work/sources.list"
	cat >"$work/apt.conf" <<-END
		Dir::State::lists "$work/lists";
		Dir::Cache "$work/cache";
		Dir::Etc::sourcelist "$work/sources.list";
		Dir::Etc::sourceparts "/dev/null";
		Dir::Etc::preferences "/dev/null";
		Dir::Etc::preferencesparts "/dev/null";
		APT::Sandbox::User "$(id -un)";
	END
	export APT_CONFIG=$work/apt.conf
	apt-get update &&
		(cd "$work" && apt-get source --download-only --tar-only "yade=$version") &&
		tar -x -f "$work"/yade_*.orig.tar.* -C "$work/tree" --strip-components=1 &&
		[ -e "$work/tree/core/Scene.hpp" ] &&
		rm -rf "$folder" && mv "$work/tree" "$folder" && rm -rf "$work"
}
