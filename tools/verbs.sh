# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Which packages a verb of `./run` needs: purposes of tools/packages.txt.

purposesOf() { # VERB ARGUMENTS…
	case $1 in
		test) echo base test fuzz revision ;; # fuzz: tests/yade/test_verbs.py configures it
		shell) echo base test ;; # for pytest
		search | accuracy | tradeoff | paper) echo base revision ;;
		figures) if [ "${2:-}" = --measure ]; then echo base peers revision; else echo base; fi ;;
		bench) echo base peers revision ;;
		fuzz) echo base fuzz ;;
		sanitize) echo base test fuzz ;;
		format) echo base style ;;
		build) if [ $# -gt 1 ] && [ "${*:2}" != overlay ]; then echo base test; else echo base; fi ;;
		*) echo base ;;
	esac
}
