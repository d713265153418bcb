#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# inRoot.sh documentation|otherYade|remove|headers PACKAGE: what `./run package --test` tries in a clean root beside debian/tests/first-scene.
set -euo pipefail

fault() { echo "FAULT: $*" >&2 && exit 1; }

# The site, where doc-base says it is: no link leads nowhere, formulas have what shows them; once the package is gone no file of it is left.
documentation() {
	local index html
	index=$(sed -n 's/^Index: //p' "/usr/share/doc-base/$1.yade-polytope")
	[ -s "$index" ] || fault "doc-base names '$index', where nothing is"
	html=$(dirname "$index")
	[ -z "$(find "$html" -xtype l)" ] || fault "links to nothing: $(find "$html" -xtype l)"
	[ -s "$html/_static/mathjax/MathJax.js" ] || fault "no MathJax"
	grep -q fromMesh "$html/searchindex.js" || fault "the search knows no function"
	python3 - "$html" <<'END' || fault "the site has broken links"
import sys

sys.path.insert(0, '/root/try')
import links

found = links.broken(sys.argv[1])
print(*found, sep='\n')
sys.exit(bool(found))
END
	apt-get purge -y "$1"
	[ ! -e "/usr/share/doc/$1" ] && [ ! -e "/usr/share/doc-base/$1.yade-polytope" ] || fault "$1 left files"
}

# YADE of another version, by what it says of itself: it goes on without the plug-in, and says why and what to do.
otherYade() {
	local config said folder
	config=$(echo /usr/lib/*/yade-double/py/yade/config.py)
	folder=$(mktemp -d)
	cd "$folder"
	cp -a "$config" kept
	sed -i "s/^version *= *'[^']*'/version='2042.1.0'/" "$config"
	grep -q "2042.1.0" "$config" || fault "config.py has no line for the version any more"
	echo 'O.bodies.append(sphere((0, 0, 0), 1)); print("went on")' >stock.py
	echo 'from yade import polytope' >ours.py
	said=$(yade -n -x stock.py 2>&1) || fault "YADE did not go on: $said"
	grep -q 'went on' <<<"$said" || fault "YADE did not go on: $said"
	for text in 'for YADE 2025' 'this is YADE 2042.1.0' "Install the package $1"; do
		grep -q "$text" <<<"$said" || fault "no '$text' in: $said"
	done
	! grep -q 'run build' <<<"$said" || fault "a command for developers in: $said"
	said=$(yade -n -x ours.py 2>&1) || true
	grep -q 'ImportError: the plug-in yade-polytope' <<<"$said" || fault "no ImportError in: $said"
	cp -a kept "$config"
}

# It depends on YADE's exact version and on no compiler; once it is gone no file of it is left.
remove() {
	local left compiler
	dpkg-query -W -f '${Depends}\n' "$1" | grep -q "libyade (= $(dpkg-query -W -f '${Version}' libyade))" || fault "libyade's version is not among: $(dpkg-query -W -f '${Depends}' "$1")"
	for compiler in gcc g++ cmake; do
		! dpkg-query -W -f '${db:Status-Status}' "$compiler" 2>/dev/null | grep -q '^installed' || fault "$compiler was installed"
	done
	[ -n "$(find /usr/lib/*/yade-double/polytope-py -name '*.pyc' -print -quit)" ] || fault "the package's modules were not compiled"
	apt-get purge -y "$1"
	# SciPy has a file of that name, too
	left=$(find / \( -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /root/try \) -prune -o -iname '*polytope*' -print |
		while read -r file; do dpkg -S "$file" >/dev/null 2>&1 || echo "$file"; done)
	[ -z "$left" ] || fault "left: $left"
	dpkg --verify libyade python3-yade
	echo 'O.bodies.append(sphere((0, 0, 0), 1)); O.step()' >/root/try/stock.py
	yade -n -x /root/try/stock.py || fault "YADE does not run"
}

# Its examples, built with what is installed: a program with the core alone, which then runs without the headers; a law that YADE finds in its
# folder, with a block at rest on it; a shape. Once the packages are gone no file of them is left.
headers() {
	local said
	cp -r "/usr/share/doc/$1/examples" /root/try
	cd /root/try/examples
	# side by side: each reads YADE's headers for a minute
	printf '%s\n' coreAlone gridPair hyperbolicJoint ownPhysics ownPoint roundedPolytope |
		xargs -P "$(nproc)" -I{} sh -c 'cmake -S {} -B {}/build -DCMAKE_BUILD_TYPE=Release && cmake --build {}/build' || fault "an example does not build"
	cmake --install ownPhysics/build
	cat >law.py <<'END'
from yade import polytope
O.materials.append(OwnJointMat(density=2600, initialStiffness=1e8, maximumClosure=1e-3, shearStiffness=1e8, frictionAngle=0.6, largestStress=1e5))
O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
O.bodies.append(polytope.cuboid(center=(0, 0, 0.5), extents=(0.5, 0.4, 0.5)))
O.engines = polytope.engines(physics=Ip2_OwnJointMat_OwnJointMat_OwnJointPhys(), law=Law2_PolytopeGeom_OwnJointPhys_Hyperbolic())
while O.time < 1:
	O.run(200, wait=True)
assert abs(O.interactions[0, 1].phys.normalForce.norm() / (9.81 * O.bodies[1].state.mass) - 1) < 1e-3
polytope.load('/root/try/examples/roundedPolytope/build/roundedPolytope.so')
print('at rest,', RoundedPolytope().__class__.__name__)
END
	said=$(yade -n -x law.py 2>&1) || fault "the extension does not run: $said"
	grep -q 'at rest, RoundedPolytope' <<<"$said" || fault "the extension says: $said"
	apt-get purge -y "$1"
	[ ! -e /usr/include/yade-polytope-double ] && [ -z "$(compgen -G '/usr/lib/*/cmake/*polytope*')" ] || fault "$1 left files"
	said=$(coreAlone/build/coreAlone)
	grep -q '^normal .* 1$' <<<"$said" || fault "the program with the core says: $said"
	apt-get purge -y 'libpolytope-core*'
}

"$@"
