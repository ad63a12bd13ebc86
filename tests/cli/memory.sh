#!/usr/bin/env bash
# memory.sh EPICYCLIC SOURCE_DIR
#
# Peak memory of a sweep, results included, does not grow with its points: 2000 more points of 3.4 kB each take no more
# than 100 bytes each; nor does that of a map. `check` of the largest studies takes less than 200 MB. Skipped (77) with
# sanitizers, whose bookkeeping grows.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
! grep -qaE '__(asan|tsan)_init' "$epicyclic" || skip "the bookkeeping of sanitizers grows"
without_drawing # gnuplot's memory is its own

# Of a study with little to compute: $1 command, $2 input, the rest what it is set to. Without lubrication the model of a
# point takes a third of the time; what is kept of the point is as large.
peak_of() {
  local command=$1 input=$2
  shift 2
  "$epicyclic" "$command" "$inputs/$input" -o out --threads 2 --set '/study/start="cold"' --set '/study/directions=["up"]' \
    --set '/integrator/method="lanes-dopri5"' --set /integrator/relative_tolerance=1e-4 --set /study/transient_periods=0 \
    --set /study/recorded_periods=8 --set /study/classification_periods=0 --set /stage/catalogue/lubrication=null \
    --set /study/output_phases=16 "$@" >stdout 2>stderr || { cat stderr >&2; exit 1; }
  sed -n 's/.*"peak_memory_KiB": *\([0-9]*\).*/\1/p' out/run.json | tail -n 1
  rm -rf out
}

# Places, and 4 MiB for buffers of fixed size that few points do not fill (tables and figures are written in blocks of
# 1 MiB, HDF5 keeps as much; those of a map are full at some 10000 cells). Points of sweeps kept in memory would take
# 23 MiB more, cells of maps 15 MiB.
is_flat() {
  echo "$1: few points $2 KiB, $3 more $4 KiB"
  [ $(($4 - $2)) -lt $(($3 * 100 / 1024 + 4096)) ] || { echo "FAILED: memory grows"; exit 1; }
}
few=$(peak_of sweep tang2020_speed.json --set /study/crosscheck/points=0 --set /study/points=500)
is_flat sweep "$few" 2000 "$(peak_of sweep tang2020_speed.json --set /study/crosscheck/points=0 --set /study/points=2500)"
cells=(--set /study/recorded_periods=2 --set /study/period_max=1 --set /study/output_phases=1)
few=$(peak_of map tang2020_map.json "${cells[@]}" --set /study/first/points=110 --set /study/second/points=110)
is_flat map "$few" 13500 "$(peak_of map tang2020_map.json "${cells[@]}" --set /study/first/points=160 --set /study/second/points=160)"

# A limit on private writable memory, which is what all points of a plan would be. By one thread and of short points: for so
# long as `check` measures how long they take.
checked() {
  (ulimit -d 200000 && "$epicyclic" check "$@" --threads 1 --set /study/transient=fixed --set /study/transient_periods=0 \
    --set /study/recorded_periods=8 --set /study/classification_periods=0 >/dev/null 2>stderr) || { echo "FAILED: check $*: $(<stderr)"; exit 1; }
  grep -q " $expected points" stderr || { echo "FAILED: check counts other points: $(<stderr)"; exit 1; }
}
expected=200000 checked "$inputs/tang2020_speed.json" --set /study/points=100000 --set '/study/start="cold"'
for start in cold continued; do
  expected=200000000 checked "$inputs/tang2020_map.json" --set /study/first/points=10000 --set /study/second/points=10000 \
    --set '/study/directions=["up","down"]' --set "/study/start=\"$start\""
done
expected=100000000 checked "$inputs/tang2020_basins.json" --set /study/first/points=10000 --set /study/second/points=10000
