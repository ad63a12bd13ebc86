#!/usr/bin/env bash
# out_of_memory.sh EPICYCLIC SOURCE_DIR
#
# With ever less memory (ulimit -v) a command ends as with enough. Or it ends with 5 and says that memory is short, or with 1
# and says that memory is short for a figure. It never ends with 70 nor by a signal, and the same command with enough
# memory goes on to the same end. Skipped with sanitizers, which take terabytes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
! grep -qaE '__(asan|tsan)_init' "$epicyclic" || skip "sanitizers take memory of their own"
without_drawing

few=(--set /study/transient=fixed --set /study/transient_periods=2 --set /study/recorded_periods=16 --set /study/classification_periods=0)
# Long records take memory; the orbits in them are rough.
sweep=(sweep "${speeds[@]}" --set /study/from=3 --set /study/points=2 --set /study/recorded_periods=2000 --set /study/transient_periods=2
  --set /study/classification_periods=0 --set /integrator/relative_tolerance=1e-4 --set /integrator/absolute_tolerance=1e-6)
gear=(gear "$inputs/tang2020.json")
run=(run "$inputs/tang2020_run.json" --set /operation/mesh_frequency_ratio=2.8 "${few[@]}" --set /study/exponent_periods=4
  --set /study/check_tolerance=1e-6 --set /study/spectrum_periods=2000 --set /study/history_periods=2000)
map=(map "$inputs/tang2020_map.json" --set /study/first/points=2 --set /study/second/points=2 "${few[@]}")

# Memory that the program begins with, in KiB: with less it ends in the dynamic linker, before its first line.
begins_with_memory() { bash -c "ulimit -v $1 && '$epicyclic' --version"; }
least=10000
until begins_with_memory $least >stdout 2>&1; do least=$((least + 2000)); done 2>/dev/null

short=0
for command in sweep gear run map; do
  declare -n arguments=$command
  expected=$(code_of "$epicyclic" "${arguments[@]}" --threads 2 -o whole)
  [ "$expected" -le 1 ] || fail "$command: $(<stderr)"
  for ((more = 500; more < 400000; more += more / 3)); do
    what="$command with $((least + more)) KiB"
    rm -rf study
    code=0
    (ulimit -v $((least + more)) && exec "$epicyclic" "${arguments[@]}" --threads 2 -o study) >stdout 2>stderr </dev/null || code=$?
    case $code in
      5)
        grep -qi 'memory' stderr || fail "$what: not told: $(<stderr)"
        short=$((short + 1))
        ;;
      "$expected") break ;;
      1) # all data are there, but gnuplot could not be started
        grep -q 'figure not drawn: .*Cannot allocate memory' stderr || fail "$what: exit code 1: $(<stderr)"
        short=$((short + 1))
        ;;
      *) fail "$what: exit code $code: $(<stderr)" ;;
    esac
  done
  [ "$(code_of "$epicyclic" "${arguments[@]}" --threads 2 -o study)" = "$expected" ] || fail "$what, then with enough: $(<stderr)"
  diff -rq -x run.json -x .lock -x 'journal*' whole study || fail "$what, then with enough: other files"
  rm -rf whole
done
[ $short -gt 0 ] || fail "memory was never short"
echo "memory was short $short times"
finish
