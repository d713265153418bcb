#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# aptInRoot.sh ROOT COMMAND ARGUMENTS…: runs the command in the Debian root, with apt's way to its mirror. Called in a mount namespace of its own,
# with APT_WAY: lines of an apt.conf for that way.
#
# Files copied from the machine (host names, proxies, certificates) are in a file system in memory that only this process sees.
set -euo pipefail
root=$1
shift

for folder in /proc /sys /dev; do mount --rbind "$folder" "$root$folder"; done
mount -t tmpfs -o mode=755 tmpfs "$root/run"
mkdir -m 700 "$root/run/way"
certificates=$(sed -n 's/^Acquire::https::CAInfo "\(.*\)";$/\1/Ip' <<<"${APT_WAY:-}" | head -n 1)
: "${certificates:=/etc/ssl/certs/ca-certificates.crt}"
{
	printf '%s\n' "${APT_WAY:-}"
	if [ -r "$certificates" ]; then
		cp "$certificates" "$root/run/way/certificates.crt"
		echo 'Acquire::https::CAInfo "/run/way/certificates.crt";'
	fi
} >"$root/run/way/apt.conf"
if [ -e /etc/resolv.conf ]; then
	cp "$(readlink -f /etc/resolv.conf)" "$root/run/way/resolv.conf"
	[ -e "$root/etc/resolv.conf" ] || touch "$root/etc/resolv.conf"
	mount --bind "$root/run/way/resolv.conf" "$root/etc/resolv.conf"
fi

unset APT_WAY LD_LIBRARY_PATH LD_PRELOAD
export APT_CONFIG=/run/way/apt.conf DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin
exec chroot "$root" "$@"
