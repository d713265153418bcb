#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# installInRoot.sh ROOT PACKAGE…: installs packages in the Debian root. Called as aptInRoot.sh is.
set -euo pipefail
root=$1
shift
# an installation that was interrupted is finished first
# shellcheck disable=SC2016
exec bash "$(dirname "${BASH_SOURCE[0]}")/aptInRoot.sh" "$root" /bin/sh -ec \
	'dpkg --configure -a; apt-get update; apt-get install -y --no-install-recommends --fix-broken "$@"; apt-get clean' sh "$@"
