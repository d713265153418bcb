# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2154
#
# `./run fuzz` and `./run sanitize`: builds of the core and its tests under clang's sanitizers, in folders of their own.
# Part of inside.sh.

# Ipopt's libraries (MPI) install crash handlers that would replace those of the sanitizers.
export UCX_ERROR_SIGNALS='' OMPI_MCA_opal_signal=''
# stacks with names; clang's own tool for it is another package
symbols=external_symbolizer_path=$(command -v addr2line)
export ASAN_OPTIONS=$symbols UBSAN_OPTIONS=print_stacktrace=1:$symbols
export LSAN_OPTIONS=print_suppressions=0:suppressions=$project/tools/measure/fuzz/leaks.txt

fuzzUsage() {
	cat <<'END'
./run fuzz [OPTIONS]: runs construction and contact on inputs that libFuzzer generates, under AddressSanitizer and UBSan

  --seconds N      for each target (default: 60)
  --target NAME    construction or contact; may be repeated (default: both)
  --seed N         of the generated inputs (default: from the clock); one seed starts with the same inputs, what follows hangs on time
  --dry-run        configures and says what would be built, nothing more
  --help           shows this

Ends with 1 if there is a crash; prints how to see it again. What was found stays in build/fuzz and is where the next run starts. Each run
leaves a log with revision, seed and duration in output/fuzz.
END
}

sanitizeUsage() {
	cat <<'END'
./run sanitize [OPTIONS]: the core, the fuzz targets and the plug-in under checkers of memory, arithmetic and threads

  --only PART      core      the core's tests under AddressSanitizer and UBSan
                   threads   queries and shapes from many threads under ThreadSanitizer
                   fuzz      ./run fuzz, 60 s a target
                   valgrind  a scene of YADE under valgrind's memcheck
                   may be repeated (default: all of them)
  --dry-run        configures and says what would be built, nothing more
  --help           shows this

All parts run, whatever one says; ends with 1 if any finds an error. Each run leaves a log with revision, durations and verdicts in
output/sanitize.
END
}

dryRun=()

# A new log in output/KIND, with what identifies the run; prints its path.
startLog() { # KIND LINE…
	local file folder=$project/output/$1
	mkdir -p "$folder"
	file=$folder/log-$(date -u +%Y%m%d-%H%M%S).txt
	shift
	{
		echo "revision $(revision)"
		echo "began    $(date -u +%Y-%m-%dT%H:%M:%SZ)"
		[ $# -eq 0 ] || printf '%s\n' "$@"
	} >"$file"
	echo "$file"
}

revision() { git -c safe.directory="$project" -C "$project" describe --always --exclude='*' --abbrev=40 --dirty 2>/dev/null || echo unknown; }

# checkedBuild FOLDER SANITIZERS TARGETS…
checkedBuild() {
	local folder=$1 sanitizers=$2
	shift 2
	(
		takeLock 9 build
		configure "$build" double # makes the build folder anew where it is another YADE's
		step "configuring for ${sanitizers//,/, }" "tools/packages.txt lists what is needed." \
			cmake -S "$project" -B "$folder" -G Ninja -DPOLYTOPE_YADE=OFF -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
			-DPOLYTOPE_IPOPT="$ipopt" -DPOLYTOPE_SANITIZE="$sanitizers" -DPOLYTOPE_FUZZ="$([ "$sanitizers" = thread ] && echo OFF || echo ON)"
		if [ ${#dryRun[@]} -gt 0 ]; then
			echo "for ${sanitizers//,/, }:"
			ninja "${dryRun[@]}" -C "$folder" "$@"
		else
			step "building for ${sanitizers//,/, }" "All messages of the compiler are in the log." ninja -C "$folder" "$@"
		fi
	) 9>"$cache/build.lock"
}

checkedMemory() { checkedBuild "$build/checked" address,undefined,float-cast-overflow "$@"; }

# fuzz OPTIONS…: see fuzzUsage
# shellcheck disable=SC2120
fuzz() {
	local seconds=60 targets=() target result=0 seed record
	seed=$(($(date +%s) % 1000000 + 1)) # libFuzzer takes 0 for a seed of its own
	while [ $# -gt 0 ]; do
		case $1 in
			--help | -h) fuzzUsage && return ;;
			--dry-run) dryRun=(-n) && shift && continue ;;
			--seconds | --target | --seed) [ $# -gt 1 ] || fail "fuzz: $1 needs a value." "./run fuzz --help lists the options." ;;
			*) fail "fuzz: there is no option '$1'." "./run fuzz --help lists the options." ;;
		esac
		case $1 in --seconds) seconds=$2 ;; --target) targets+=("$2") ;; --seed) seed=$2 ;; esac
		shift 2
	done
	[ ${#targets[@]} -gt 0 ] || targets=(construction contact)
	[[ $seconds =~ ^[1-9][0-9]{0,8}$ ]] || fail "fuzz: --seconds '$seconds' is not a number of seconds."
	[[ $seed =~ ^[1-9][0-9]{0,8}$ ]] || fail "fuzz: --seed '$seed' is not a whole number from 1 to 999999999."
	for target in "${targets[@]}"; do
		case $target in construction | contact) ;; *) fail "fuzz: there is no target '$target'." "They are: construction, contact." ;; esac
	done
	checkedMemory "${targets[@]/#/polytope_fuzz_}" "${targets[@]/#/polytope_replay_}" || return 1
	[ ${#dryRun[@]} -eq 0 ] || return 0
	record=$(startLog fuzz "seed     $seed")
	{
		printf '\n%-14s %8s %12s %10s %10s %8s\n' target seconds executions coverage 'new units' crashes
		for target in "${targets[@]}"; do fuzzTarget "$target" "$seconds" "$seed" || result=1; done
	} > >(tee -a "$record")
	wait $!
	echo "ended    $(date -u +%Y-%m-%dT%H:%M:%SZ)" >>"$record"
	echo "log: $record"
	return $result
}

# One line of the table; on a crash what it was and how to see it again.
fuzzTarget() {
	local target=$1 seconds=$2 seed=$3 programs=$build/checked/tools/measure/fuzz work=$build/fuzz/$1 log=$logs/fuzz-$1.log crashed=0 file
	rm -rf "$work/crashes"
	mkdir -p "$work/corpus" "$work/crashes" "$logs"
	"$programs/polytope_replay_$target" --unpack "$work/seeds" "$project/tools/measure/fuzz/$target.corpus" || return 1
	"$programs/polytope_fuzz_$target" -seed="$seed" -max_total_time="$seconds" -max_len=400 -timeout=60 -print_final_stats=1 \
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

# The parts of sanitize; each builds what it needs.

checkCore() {
	checkedMemory || return 1
	[ ${#dryRun[@]} -eq 0 ] || return 0
	ctest --test-dir "$build/checked" --output-on-failure -j "$(nproc)" -E '^(Instructions|Allocation|Clang)'
}

checkThreads() {
	checkedBuild "$build/checked-threads" thread polytope_core_tests || return 1
	[ ${#dryRun[@]} -eq 0 ] || return 0
	TSAN_OPTIONS=halt_on_error=1:$symbols OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
		"$build/checked-threads/tests/core/polytope_core_tests" --gtest_filter='ParallelQueries.*:ConvexShape.SharingIsThreadSafe'
}

# shellcheck disable=SC2119
checkFuzz() { fuzz; }

checkValgrind() {
	[ ${#dryRun[@]} -eq 0 ] || return 0
	(build) && python3 "$project/tests/yade/memcheck.py"
}

# sanitize OPTIONS…: see sanitizeUsage
sanitize() {
	local parts=() part result=0 verdicts=() record='' began
	while [ $# -gt 0 ]; do
		case $1 in
			--help | -h) sanitizeUsage && return ;;
			--dry-run) dryRun=(-n) && shift && continue ;;
			--only) [ $# -gt 1 ] || fail "sanitize: --only needs a value." "./run sanitize --help lists the parts." ;;
			*) fail "sanitize: there is no option '$1'." "./run sanitize --help lists the options." ;;
		esac
		case $2 in
			core | threads | fuzz | valgrind) parts+=("$2") ;;
			*) fail "sanitize: there is no part '$2'." "They are: core, threads, fuzz, valgrind." ;;
		esac
		shift 2
	done
	[ ${#parts[@]} -gt 0 ] || parts=(core threads fuzz valgrind)
	[ ${#dryRun[@]} -gt 0 ] || record=$(startLog sanitize)
	for part in "${parts[@]}"; do
		printf '\n%s: ' "$part"
		case $part in
			core) echo "tests of the core under AddressSanitizer and UBSan" ;;
			threads) echo "queries and shapes from many threads under ThreadSanitizer" ;;
			fuzz) echo "construction and contact under libFuzzer" ;;
			valgrind) echo "a scene of YADE under valgrind" ;;
		esac
		began=$SECONDS
		if ("check${part^}"); then verdicts+=("$part: sound"); else verdicts+=("$part: ERRORS") && result=1; fi
		[ -z "$record" ] || echo "${verdicts[-1]}, $((SECONDS - began)) s" >>"$record"
	done
	[ -n "$record" ] || return $result
	echo "ended    $(date -u +%Y-%m-%dT%H:%M:%SZ)" >>"$record"
	echo && printf '%s\n' "${verdicts[@]}" "log: $record"
	return $result
}
