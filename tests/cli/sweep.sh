#!/usr/bin/env bash
# sweep.sh EPICYCLIC SOURCE_DIR
#
# The life of an output folder: same bytes at 1, 2 and 8 threads and with each instruction set, complete, another study, in use,
# damaged journal, files that cannot grow, resolved input that reproduces the study. Signals, kill -9, a full disk and simultaneous
# starts: see there.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

small=(--set /study/points=6 --set /study/transient_periods=8 --set /study/recorded_periods=8
  --set /study/classification_periods=192)
sweep() { "$epicyclic" sweep "${speeds[@]}" "${small[@]}" "$@"; }

# The first is drawn, and its pictures are looked at below.
for threads in 1 2 8; do
  [ "$(code_of sweep -o "t$threads" --threads "$threads")" = 0 ] || fail "sweep with $threads threads: $(<stderr)"
  [ "$threads" != 1 ] || without_drawing
done
same_results t1 t2
same_results t1 t8
# Segments, which start from a pass that threads share: again and again, since who asks first is a matter of chance.
many=("${speeds[@]}" --set /study/points=129 --set /study/output_phases=8 --set /study/coarse_periods=3 --set '/study/directions=["up"]'
  --set /study/transient_periods=2 --set /study/recorded_periods=2 --set /study/classification_periods=0 --set /integrator/relative_tolerance=1e-5)
for method in arkode-dopri5 lanes-cash-karp; do
  for threads in 1 2 3 5 8; do
    [ "$(code_of "$epicyclic" sweep "${many[@]}" --set "/integrator/method=$method" -o "many$threads" --threads "$threads")" = 0 ] ||
      fail "segments, $method, $threads threads: $(<stderr)"
    same_results many1 "many$threads"
  done
  rm -r many*
done
# Whatever the machine's instruction set: each as wide as it may be and the machine is.
for method in arkode-dopri5 lanes-cash-karp; do
  for simd in baseline avx2 avx512; do
    export EPICYCLIC_SIMD=$simd
    [ "$(code_of sweep --set "/integrator/method=$method" -o "$method.$simd")" = 0 ] || fail "$method, $simd: $(<stderr)"
    same_results "$method.baseline" "$method.$simd"
  done
  grep -q '"simd": "baseline"' "$method.baseline/run.json" || fail "$method: EPICYCLIC_SIMD was no limit"
done
[ "$(EPICYCLIC_SIMD=sse code_of sweep -o none)" = 2 ] || fail "an unknown instruction set must give exit 2"
[ ! -e none ] || fail "an unknown instruction set left a folder"
unset EPICYCLIC_SIMD
[ "$(wc -l <t1/points.csv)" = 13 ] || fail "points.csv must have a header and 12 rows"
[ "$(wc -l <t1/poincare.csv)" = 97 ] || fail "poincare.csv must have a header and 12 x 8 rows"
for figure in bifurcation_delta_sp bifurcation_delta_rp; do
  for kind in png svg gp dat; do [ -s "t1/figures/$figure.$kind" ] || fail "figures/$figure.$kind is missing"; done
done

# Complete: nothing is computed again, nothing changes.
before=$(sha256sum t1/points.csv t1/run.json)
[ "$(code_of sweep -o t1)" = 0 ] || fail "a complete folder must give exit 0"
[ "$before" = "$(sha256sum t1/points.csv t1/run.json)" ] || fail "a complete folder was changed"

# Another study, a foreign folder, a folder in use.
[ "$(code_of sweep -o t1 --set /integrator/relative_tolerance=1e-7 --set /study/to=3)" = 3 ] || fail "another study must give exit 3"
for line in '/integrator/relative_tolerance: 1e-08 there, 1e-07 here' '/study/to: 3.5 there, 3.0 here'; do
  grep -qxF "  $line" stderr || fail "exit 3 does not say: $line"
done
[ "$(wc -l <stderr)" = 3 ] || fail "exit 3 says more: $(<stderr)"
mkdir foreign && echo mine >foreign/thesis.txt
[ "$(code_of sweep -o foreign)" = 3 ] || fail "a foreign folder must give exit 3"
[ "$(ls foreign)" = thesis.txt ] || fail "a foreign folder was written to"
mkdir busy
(
  flock 9
  [ "$(code_of sweep -o busy)" = 4 ] || fail "a folder in use must give exit 4"
  exit "$failed"
) 9>busy/.lock || failed=$((failed + 1))

# The resolved input is an input and gives the same numbers.
[ "$(code_of "$epicyclic" sweep t1/input.resolved.json -o resolved)" = 0 ] || fail "resolved input: $(<stderr)"
cmp -s t1/points.csv resolved/points.csv || fail "the resolved input gives other points"

longer=(--set /study/points=24 --set /study/transient_periods=60 --set /study/classification_periods=64)
sweep "${longer[@]}" -o whole >stdout 2>stderr
# Five lines at most, with a command that can be typed as the program was called.
[ "$(wc -l <stdout)" -le 5 ] || fail "a sweep prints more than five lines: $(<stdout)"
grep -q "next: $epicyclic " stdout || fail "no next command: $(<stdout)"
eval "next=($(sed -n 's/.*next: //p' stdout))"
[ "${next[1]}" != run ] || next+=(--set /study/exponent_periods=0 --set /study/classification_periods=64)
[ "$(code_of "${next[@]}" --set /study/transient_periods=0)" != 2 ] || [ "${next[1]}" = continue ] || fail "${next[*]}: $(<stderr)"
grep -q '^## Not certain$' whole/sweep.md || [ "${next[1]}" = continue ] || fail "sweep.md: $(<whole/sweep.md)"

# A journal that was damaged in the middle is refused, not repaired.
cp -r whole damaged
sed -i 's/"state": *"complete"/"state": "running"/' damaged/run.json
printf '\xff\x00\xff' | dd of=damaged/journal.bin bs=1 seek=5000 conv=notrunc status=none
[ "$(code_of sweep "${longer[@]}" -o damaged)" = 7 ] || fail "a damaged journal must give exit 7: $(<stderr)"

# A full disk: what a file system of limited size does to a running sweep, by a limit on the size of files.
(ulimit -f 64; sweep "${longer[@]}" -o full >stdout 2>stderr) && fail "a full disk must not give exit 0" || {
  code=$?
  [ "$code" = 5 ] || fail "a full disk must give exit 5, not $code"
}
[ "$(code_of sweep "${longer[@]}" -o full)" = 0 ] || fail "resume after a full disk: $(<stderr)"
same_results whole full

# A study with failed points says so each time.
for attempt in 1 2; do
  [ "$(code_of sweep --set /integrator/max_steps_per_period=3 -o few_steps)" = 1 ] || fail "failed points must give exit 1"
done
grep -q ',step_limit,' few_steps/points.csv || fail "points.csv must name the step limit"

# What cannot be swept is refused before anything is written; so is a value inside the range that breaks a rule.
refused() {
  [ "$(code_of sweep "$@" -o refused)" = 2 ] || fail "must be refused: $*"
  [ ! -e refused ] || fail "refused, but written to: $*"
}
pointer() { refused --set "/study/parameter=$1" --set "/study/from=$2" --set "/study/to=$3" --set "/study/points=$4"; }
pointer /stage/planets/count 2 6 5
pointer /integrator/relative_tolerance 1e-10 1e-2 3
pointer /stage/lumped/sun/teeth 26 28 5
[ "$(PATH=$with_gnuplot code_of sweep --json -o $'odd\xff name')" = 0 ] || fail "an odd folder name: $(<stderr)"
[ "$(code_of "$epicyclic" schema)" = 0 ] && [ -s stdout ] || fail schema
code=0
"$epicyclic" schema >/dev/full 2>stderr || code=$?
[ "$code" = 5 ] || fail "output that cannot be written must give exit 5, not $code"

# The other commands.
[ "$(code_of "$epicyclic" check "${speeds[@]}" "${small[@]}" --threads 2)" = 0 ] || fail "check: $(<stderr)"
grep -q '^time: .* on 2 threads of this machine, by what [0-9]* of ' stderr || fail "check tells no time: $(<stderr)"
[ "$(code_of "$epicyclic" check "$inputs/tang2020_run.json" --set /study/transient_periods=20 --set /study/exponent_periods=200)" = 0 ] || fail "check of a run: $(<stderr)"
grep -q '^time: about .* on 1 thread of this machine, and its figures, by [0-9a-z]' stderr || fail "check tells no time of a run: $(<stderr)"
[ "$(code_of "$epicyclic" check "$inputs/tang2020_tolerance.json" --threads 2 --set '/study/methods=["arkode-dopri5"]' --set '/study/tolerances=[1e-6, 1e-7, 1e-8]' --set /study/reference_tolerance=1e-12)" = 0 ] || fail "check of a ladder: $(<stderr)"
grep -q '^time: .* on 2 threads of this machine, by what ' stderr || fail "check tells no time of a ladder: $(<stderr)"
for study in "$inputs"/*.json; do
  [ "$(code_of "$epicyclic" check --no-time "$study")" = 0 ] || fail "check $study: $(<stderr)"
done
[ "$(code_of "$epicyclic" schema)" = 0 ] || fail schema
[ "$(code_of "$epicyclic" gear "$inputs/lin_parker_1999_n3.json" -o gear)" = 0 ] || fail "gear: $(<stderr)"
[ "$(wc -l <gear/modes.csv)" = 13 ] || fail "modes.csv of three planets must have a header and 12 rows"
[ "$(code_of "$epicyclic" sweep "$inputs/lin_parker_1999_n3.json" -o no)" = 2 ] || fail "a stage alone cannot be swept"
[ "$(code_of "$epicyclic")" = 2 ] || fail "no subcommand must give exit 2"
[ "$(code_of "$epicyclic" sweep --threads 0 x -o y)" = 2 ] || fail "--threads 0 must give exit 2"

finish
