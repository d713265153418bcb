#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# enterRoot.sh ROOT COMMAND ARGS…: runs the command in the Debian root. Called in a mount namespace of its own.
#
# All folders of the machine save the system's own are mounted at their places: the project, the home folder and any
# path a user may name are the same inside.
set -euo pipefail
root=$1
shift

place() { # mounts the machine's $1 at its place in the root, or at $2
	local at=$root${2:-$1}
	if [ -d "$1" ]; then mkdir -p "$at"; else mkdir -p "$(dirname "$at")" && touch "$at"; fi
	mount --rbind "$1" "$at"
}

for folder in /* /var/tmp /run/user; do
	case $folder in
		/bin | /boot | /dev | /etc | /lib* | /lost+found | /proc | /run | /sbin | /sys | /usr | /var) continue ;;
	esac
	if [ -d "$folder" ] && [ ! -L "$folder" ]; then place "$folder"; fi
done
for folder in /proc /sys /dev; do place "$folder"; done
place /etc/hosts
# for network access: host names and certificates
for file in /etc/resolv.conf /etc/ssl/certs/ca-certificates.crt; do [ ! -e "$file" ] || place "$(readlink -f "$file")" "$file"; done

# settings for the machine's own programs would break those in the root
unset LD_LIBRARY_PATH LD_PRELOAD PYTHONPATH PYTHONHOME VIRTUAL_ENV
export LC_ALL=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
here=$PWD
# shellcheck disable=SC2016
exec chroot "$root" /bin/bash -c 'cd "$0" 2>/dev/null || cd /; exec "$@"' "$here" "$@"
