#!/usr/bin/env bash
# memory.sh EPICYCLIC SOURCE_DIR
#
# Peak memory of a sweep, results included, does not grow with its points: 4500 more points of 3.4 kB each take no more
# than 100 bytes each. Skipped (77) with sanitizers, whose bookkeeping grows.
set -euo pipefail

epicyclic=$1
inputs=$2/inputs
! grep -qaE '__(asan|tsan)_init' "$epicyclic" || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

peak_of() {
  "$epicyclic" sweep "$inputs/tang2020_speed.json" -o "points.$1" --threads 2 --set "/study/points=$1" \
    --set '/study/directions=["up"]' --set '/study/start="cold"' --set '/integrator/method="lanes-dopri5"' \
    --set /integrator/relative_tolerance=1e-4 --set /study/transient_periods=0 --set /study/recorded_periods=8 \
    --set /study/classification_periods=0 >stdout 2>stderr || { cat stderr >&2; exit 1; }
  sed -n 's/.*"peak_memory_KiB": *\([0-9]*\).*/\1/p' "points.$1/run.json" | tail -n 1
}

few=$(peak_of 500)
many=$(peak_of 5000)
echo "500 points: $few KiB, 5000 points: $many KiB"
# Plan, chains, places, and 4 MiB for buffers of fixed size that few points do not fill (tables and figures are written
# in blocks of 1 MiB, HDF5 keeps as much). Points kept in memory would take 53 MiB more.
[ $((many - few)) -lt $((4500 * 100 / 1024 + 4096)) ]
