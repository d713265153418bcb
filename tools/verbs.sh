# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Which packages a verb of `./run` needs: purposes of tools/packages.txt. Which options it takes. Needs messages.sh.

purposesOf() { # VERB ARGUMENTS…
	case $1 in
		test) echo base test docs fuzz revision ;; # fuzz: tests/yade/project/test_verbs.py configures it
		docs) echo base docs ;;
		shell) echo base test ;; # for pytest
		search | accuracy | tradeoff | paper) echo base revision ;;
		figures) if [ "${2:-}" = --measure ]; then echo base peers revision; else echo base; fi ;;
		bench) echo base peers revision ;;
		fuzz) echo base fuzz ;;
		sanitize) echo base test fuzz ;;
		format) echo base style ;;
		package) echo base docs package revision ;;
		build) if [ $# -gt 1 ] && [ "${*:2}" != overlay ]; then echo base test; else echo base; fi ;;
		*) echo base ;;
	esac
}

# Options of a verb besides --help. tests/yade/project/test_verbs.py compares them, and the names below, with what the programs themselves list.
optionsOf() { # VERB
	case $1 in
		demo)
			echo --quick --output --no-pictures --shape --number --steps --threads --seed --seeds --contact-model --contact-point \
				--size --density --normal-stiffness --stiffness-ratio --friction-angle --contact-damping --damping --gravity --corner-fraction \
				--time-step-fraction --vtk-every --sample-every --ipopt-every
			;;
		paper | accuracy) echo --quick --only --fresh --output --jobs ;;
		tradeoff) echo --quick --only --output ;;
		bench) echo --quick --only --output --large --beside ;;
		fuzz) echo --seconds --target --seed --dry-run ;;
		sanitize) echo --only --dry-run ;;
		search) echo --quick --pairs --seed --threads --family --trial --log ;;
		format) echo --check ;;
		package) echo --ipopt --test ;;
	esac
}

# What --only of a verb (--target of fuzz) names; those of paper are letters in one word.
namesOf() { # VERB
	case $1 in
		accuracy) echo pairs scenes path surfaces collisions joints ;;
		bench) echo kernels shapes scenes sizes scale growth threads results ;;
		fuzz) echo construction contact ;;
		sanitize) echo core threads fuzz valgrind ;;
		tradeoff) echo pair B C D F rest A ;;
	esac
}

# Refuses what a verb does not take, before anything is installed or built. Other values than names are checked by the programs.
checkArguments() { # VERB ARGUMENTS…
	local verb=$1 argument options names of=''
	shift
	options=$(optionsOf "$verb") names=$(namesOf "$verb")
	case $verb in
		demo | paper | tradeoff | bench | fuzz | sanitize | accuracy | search | docs) options+=" --help -h" ;;
		test) checkTestArguments "$@" && return ;;
		format | build | package) ;;
		*) return 0 ;; # yade, python, shell: options of those programs
	esac
	for argument in "$@"; do
		case $argument in
			-[0-9]*) ;; # a value
			-*)
				of=${argument%%=*}
				case " $options " in
					*" $of "*) ;;
					*) fail "$verb: there is no option '$of'." "${options:+They are: $options. }./run help lists all commands." ;;
				esac
				case $argument in *=*) argument=${argument#*=} ;; *) continue ;; esac
				;;
		esac
		[ "$verb" != package ] || fail "package: takes no '$argument'." "It takes --ipopt and --test."
		[ "$verb" != format ] || fail "format: takes no '$argument'." "It formats all files; --check only checks them."
		case $verb$of in
			*--only | fuzz--target) [ -z "$names" ] || case " $names " in *" $argument "*) ;; *) fail "$verb: $of '$argument' is unknown." "They are: $names." ;; esac ;;
		esac
	done
}

# What pytest runs for a place: core, tools, a room (folder of tests/yade), the name of a test file, or a path with or without the name of a test.
placeOf() { # PLACE
	local found
	case $1 in
		core) echo core && return ;;
		tools) echo tests/tools && return ;;
	esac
	if [ -d "$project/tests/yade/$1" ]; then echo "tests/yade/$1" && return; fi
	if [ -e "$project/${1%%::*}" ]; then echo "$1" && return; fi
	found=$(cd "$project" && find tests/yade tests/tools -name "$(basename "${1%%::*}" .py).py" 2>/dev/null)
	[ -n "$found" ] || fail "test: there is no place '$1'." "They are: core, tools, $(cd "$project/tests/yade" && printf '%s\n' */test_*.py | cut -d/ -f1 | uniq | sed 's/$/,/' | tr '\n' ' ')and test files."
	case $1 in *::*) echo "$found::${1#*::}" ;; *) echo "$found" ;; esac
}

# Places, --fast, and what is meant for it; all other options are pytest's, which checks them before anything is built (test.sh).
checkTestArguments() { # ARGUMENTS…
	local argument
	for argument in "$@"; do
		case $argument in
			--fast) ;;
			-*) break ;;
			*) placeOf "$argument" >/dev/null || exit ;;
		esac
	done
	for argument in "$@"; do
		case $argument in
			--fast | --ff | --failed-first | --fixtures* | --full-trace | --funcargs) ;;
			--f*) fail "test: there is no option '$argument'." "Its own is --fast; all others are pytest's." ;;
		esac
	done
}
