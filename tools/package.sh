# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run package`: Debian packages for the YADE that is installed here, of the plug-in, its documentation, its headers and its core, into output/package. Part of inside.sh. debian/ has the rules.

# The version: that of the sources, then the YADE it is for. The sources have the one in debian/changelog, and unless this is the tagged release, a suffix of
# time and commit, which sorts before it.
packageVersion() {
	local version of=(git -c safe.directory="$project" -C "$project") commit
	version=$(dpkg-parsechangelog -l "$project/debian/changelog" -S Version)
	if commit=$("${of[@]}" show -s --date=format:%Y%m%d.%H%M --format=%cd.%h 2>/dev/null) &&
		[ "$("${of[@]}" describe --tags --dirty 2>/dev/null)" != "v${version%-*}" ]; then
		[ -z "$("${of[@]}" status --porcelain)" ] || commit+=.changed
		version=${version%-*}~$commit-${version##*-}
	fi
	echo "$version+yade$(dpkg-query -W -f '${source:Upstream-Version}' libyade)"
}

# buildPackage [--ipopt]
buildPackage() {
	local name=yade-polytope profile=() folder=$build/package tree output=$project/output/package version
	[ "$precision" = double ] || fail "package: made for YADE in double alone, not in $precision." "Leave YADE_POLYTOPE_PRECISION away."
	if [ "${1:-}" = --ipopt ]; then name+=-ipopt profile=(--build-profiles=pkg.yade-polytope.ipopt); fi
	folder+=/$name tree=$folder/sources version=$(packageVersion)
	# Debian's tools write into the tree and beside it
	rm -rf "$folder"
	mkdir -p "$tree" "$output"
	tar -C "$project" -c --exclude=__pycache__ CMakeLists.txt CHANGELOG.md CITATION.cff LICENSE README.md cmake debian docs examples pkg py src tools/site | tar -C "$tree" -x
	sed -i "1s/([^)]*)/($version)/" "$tree/debian/changelog"
	# without symbols for a debugger: with them YADE's headers take three times the memory
	(
		cd "$tree" || exit
		unset PYTHONPATH YADE_PREFIX
		export YADE_SOURCE_DIR=$yadeSource DEB_BUILD_OPTIONS="noautodbgsym parallel=$cores" DEB_CXXFLAGS_STRIP=-g
		step "building the package $name" "Debian's rules are in debian/." dpkg-buildpackage --build=binary --no-sign "${profile[@]}"
	)
	step "checking it with lintian" "lintian-explain-tags TAG explains an error." lintian --allow-root --fail-on error "$folder"/*.changes
	rm -f "$output/$name"_*.deb
	[ "$name" != yade-polytope ] || rm -f "$output/$name"-d{oc,ev}_*.deb "$output"/libpolytope-core*.deb
	mv "$folder"/*.deb "$output"
	rm -rf "$folder"
	echo "  Install it, on a Debian with YADE $(dpkg-query -W -f '${Version}' libyade): sudo apt install $(compgen -G "$output/$name"_*.deb)"
}
