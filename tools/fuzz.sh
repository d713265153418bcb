# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run fuzz` and `./run sanitize`: builds of the core and its tests under clang's sanitizers, in folders of their own.
# Part of inside.sh.

# Ipopt's libraries (MPI) bring handlers of crashes along that would take them from the sanitizers.
export UCX_ERROR_SIGNALS='' OMPI_MCA_opal_signal=''
export ASAN_OPTIONS=allow_addr2line=1 UBSAN_OPTIONS=print_stacktrace=1:allow_addr2line=1

# checkedBuild FOLDER SANITIZERS TARGETS…
checkedBuild() {
	local folder=$1 sanitizers=$2
	shift 2
	(
		flock 9
		configure # makes the build folder anew where it is another YADE's
		step "configuring for ${sanitizers//,/, }" "tools/packages.txt lists what is needed." \
			cmake -S "$project" -B "$folder" -G Ninja -DPOLYTOPE_YADE=OFF -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
			-DPOLYTOPE_SANITIZE="$sanitizers" -DPOLYTOPE_FUZZ="$([ "$sanitizers" = thread ] && echo OFF || echo ON)"
		step "building for ${sanitizers//,/, }" "All messages of the compiler are in the log." ninja -C "$folder" "$@"
	) 9>"$cache/build.lock"
}

checkedMemory() { checkedBuild "$build/checked" address,undefined,float-cast-overflow "$@"; }

# fuzz [--seconds N] [--target construction|contact]
fuzz() {
	local seconds=60 targets=() target result=0
	while [ $# -gt 0 ]; do
		case $1 in
			--seconds) seconds=${2:?--seconds needs a number} ;;
			--target) targets+=("${2:?--target needs construction or contact}") ;;
			*) fail "fuzz: there is no option '$1'." "./run fuzz [--seconds N] [--target construction|contact]" ;;
		esac
		shift 2
	done
	[ ${#targets[@]} -gt 0 ] || targets=(construction contact)
	[[ $seconds =~ ^[1-9][0-9]*$ ]] || fail "fuzz: --seconds $seconds is not a number of seconds."
	for target in "${targets[@]}"; do
		case $target in construction | contact) ;; *) fail "fuzz: there is no target '$target'." "They are: construction, contact." ;; esac
	done
	checkedMemory "${targets[@]/#/polytope_fuzz_}" "${targets[@]/#/polytope_replay_}"
	printf '\n%-14s %8s %12s %10s %10s %8s\n' target seconds executions coverage 'new units' crashes
	for target in "${targets[@]}"; do fuzzTarget "$target" "$seconds" || result=1; done
	return $result
}

# One line of the table; on a crash what it was and how to see it again.
fuzzTarget() {
	local target=$1 seconds=$2 programs=$build/checked/tests/fuzz work=$build/fuzz/$1 log=$logs/fuzz-$1.log crashed=0 file
	rm -rf "$work/crashes"
	mkdir -p "$work/corpus" "$work/crashes" "$logs"
	"$programs/polytope_replay_$target" --unpack "$work/seeds" "$project/tests/fuzz/$target.corpus"
	"$programs/polytope_fuzz_$target" -max_total_time="$seconds" -max_len=400 -timeout=60 -print_final_stats=1 \
		-artifact_prefix="$work/crashes/" "$work/corpus" "$work/seeds" >"$log" 2>&1 </dev/null || crashed=1
	awk -v target="$target" -v seconds="$seconds" -v crashes=$crashed '
		/ cov: /                           { for (i = 1; i < NF; ++i) if ($i == "cov:") coverage = $(i + 1) }
		/stat::number_of_executed_units:/ { executions = $2 }
		/stat::new_units_added:/          { units = $2 }
		END { printf "%-14s %8s %12s %10s %10s %8s\n", target, seconds, executions, coverage, units, crashes }' "$log"
	[ $crashed -eq 0 ] && return
	grep -m 3 -E 'violated:|runtime error:|ERROR:' "$log" | cut -c 1-200 | sed 's/^/    /'
	echo "    log: $log"
	for file in "$work"/crashes/*; do
		[ -e "$file" ] && echo "    again: ./run shell -c '$programs/polytope_replay_$target $file'"
	done
	return 1
}

# The core's tests under ASan and UBSan, threads under TSan, the fuzz targets, a scene of YADE under valgrind. All run, whatever one says.
sanitize() {
	[ $# -eq 0 ] || fail "sanitize: there is no option '$1'."
	local result=0
	checkedMemory
	checkedBuild "$build/checked-threads" thread polytope_core_tests
	printf '\nTests of the core under AddressSanitizer and UBSan\n'
	ctest --test-dir "$build/checked" --output-on-failure -j "$(nproc)" -E '^(Instructions|Allocation)' || result=1
	printf '\nThreads under ThreadSanitizer\n'
	TSAN_OPTIONS=halt_on_error=1:allow_addr2line=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
		"$build/checked-threads/tests/core/polytope_core_tests" --gtest_filter='ParallelQueries.*' || result=1
	fuzz || result=1
	printf '\nA scene of YADE under valgrind\n'
	python3 "$project/tests/yade/memcheck.py" || result=1
	return $result
}
