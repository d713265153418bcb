#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# place.sh YADE_SOURCE FOLDER: a copy of YADE's source tree in FOLDER, with this project's C++ in pkg/polytope/ of it and the option ENABLE_POLYTOPE (on) in
# its CMakeLists.txt. Prints how to configure it. docs/developing.md, Into YADE itself, has what else a merge request needs.
set -euo pipefail
[ $# -eq 2 ] || { sed -n '4,5s/^# //p' "$0" >&2 && exit 2; }
source=$1 folder=$2
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
[ -e "$source/core/Scene.hpp" ] || { echo "place.sh: $source is no source tree of YADE." >&2 && exit 1; }
[ ! -e "$folder" ] || { echo "place.sh: $folder exists; name a new folder." >&2 && exit 1; }

cp -r "$source" "$folder"
cp -r "$project/pkg/polytope" "$folder/pkg/polytope"
cp -r "$project/src" "$project/cmake" "$folder/pkg/polytope"
version=$(sed -n 's/^project(yade-polytope VERSION \([0-9.]*\) .*/\1/p' "$project/CMakeLists.txt")
sed "s/@VERSION@/$version/" "$project/tools/upstream/CMakeLists.txt.in" >"$folder/pkg/polytope/CMakeLists.txt"

# behind the list of disabled packages, before YADE's loop over its packages; and behind that loop
before='^SUBDIRLIST(SUBDIRS_PKG ' after='^# see comment .*merge_requests'
for place in "$before" "$after"; do
	grep -q "$place" "$folder/CMakeLists.txt" || { echo "place.sh: YADE's CMakeLists.txt has no line '$place' any more." >&2 && exit 1; }
done
sed -i "/$before/i LIST(APPEND disabled_pkgs_list \"polytope\") # has a CMakeLists.txt of its own
0,/$after/{/$after/i OPTION(ENABLE_POLYTOPE \"Convex polyhedra by linear programming\" ON)\nIF(ENABLE_POLYTOPE)\n\tADD_SUBDIRECTORY(pkg/polytope)\n\tTARGET_LINK_LIBRARIES(boot pkg_polytope)\nENDIF()
}" "$folder/CMakeLists.txt"
echo "cmake -S $folder -B $folder/build -G Ninja -DENABLE_USEFUL_ERRORS=OFF"
