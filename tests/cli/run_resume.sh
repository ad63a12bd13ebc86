#!/usr/bin/env bash
# run_resume.sh EPICYCLIC SOURCE_DIR
#
# `run` goes on where a stop or a kill left it, in the midst of its Lyapunov exponents: the same bytes as without, by one thread
# and two, of a periodic and a chaotic motion; no result that is in the journal is computed again; and how long exponents take
# is said as they begin. A complete run keeps no journal.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing
command -v perl >/dev/null || skip "there is no perl to read the journal with"

few=("$inputs/tang2020_run.json" --set /study/transient=fixed --set /study/transient_periods=20 --set /study/recorded_periods=16
  --set /study/check_tolerance=1e-6 --set /study/spectrum_periods=16 --set /study/history_periods=2
  --set "/study/exponent_periods=$(or_if_slow 100 12)")
periodic=("$epicyclic" run "${few[@]}" --set /operation/mesh_frequency_ratio=2.8)
chaotic=("$epicyclic" run "${few[@]}" --set /operation/mesh_frequency_ratio=1.2 --set /study/transient_periods=100
  --set /study/recorded_periods=64 --set /study/classification_periods=256)

# Records of the exponents, of the whole journal.
exponents_in() { journal_records "$1/journal.bin" | awk '$2 == 1' | wc -l; }

for regime in periodic chaotic; do
  declare -n command=$regime
  [ "$(code_of "${command[@]}" --threads 2 -o $regime)" = 0 ] || fail "$regime: $(<stderr)"
  grep -q ",$regime," $regime/points.csv || fail "the motion is not $regime: $(cut -d, -f5 $regime/points.csv | tail -n 1)"
  [ ! -e $regime/journal.bin ] || fail "$regime: a complete run keeps its journal"

  # Stopped as soon as some exponents are there; then the same command knows them.
  for threads in 1 2; do
    folder=$regime.$threads
    "${command[@]}" --threads $threads -o $folder >stdout 2>stderr &
    pid=$!
    until [ "$(exponents_in $folder)" -ge 10 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
    kill -TERM $pid 2>/dev/null || true
    code=0
    wait $pid || code=$?
    [ "$code" = 75 ] || fail "$folder: stopped, it ended with $code: $(<stderr)"
    grep -q 're-run the same command to resume' stderr || fail "$folder: does not say that it goes on: $(<stderr)"
    known=$(exponents_in $folder)
    "${command[@]}" --threads $threads -o $folder >stdout 2>stderr || fail "$folder: resumed: $(<stderr)"
    grep -q "the point and $known of .* exist already" stderr || fail "$folder: $known were there, but: $(<stderr)"
    same_folder $regime $folder
  done

  killed_until_done "$regime.killed" 400 "${command[@]}" --threads 2 -o $regime.killed
  same_folder $regime $regime.killed
done

# Long enough to be told.
"${periodic[@]}" --set /study/exponent_periods=20000 -o long >stdout 2>stderr &
pid=$!
for ((k = 0; k < 600; ++k)); do
  ! grep -q 'Lyapunov exponents over 20050 mesh periods .*take about .* more' stderr || break
  sleep 0.1
done
kill -TERM $pid
wait $pid || true
grep -q 'Lyapunov exponents over 20050 mesh periods .*take about .* more' stderr || fail "how long it takes is not said: $(<stderr)"
finish
