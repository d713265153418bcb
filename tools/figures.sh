# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run figures`: figures of README and docs, from results that are there or are measured first. Part of inside.sh.

# A target that is missed, exit code 1, is a result.
figures() {
	local writer=$project/tools/measure/results/results.py name=${2:-} into=$project/output/figures/${2:-} code=0 option=--output
	[ "${1:-}" = --measure ] || exec python3 "$writer" "$@"
	case $name in
		bench | tradeoff | accuracy | paper) ;;
		search) into=$into.txt option=--log ;;
		*) fail "figures: --measure needs bench, tradeoff, accuracy, paper or search." "./run figures --help says more." ;;
	esac
	mkdir -p "$project/output/figures"
	# a process of its own: with `||`, bash would go on after a command of a function that fails
	bash "$project/tools/inside.sh" "$name" "${@:3}" $option "$into" || code=$?
	[ $code -lt 2 ] || fail "./run $name ended with $code: nothing is taken over."
	python3 "$writer" --take "$name" "$into"
}
