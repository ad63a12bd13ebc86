#!/usr/bin/env bash
# memory.sh EPICYCLIC SOURCE_DIR
#
# Peak memory of a sweep, results included, does not grow with its points: ten times the points of 3.4 kB each take no
# more than 100 bytes for each more. Skipped (77) with sanitizers, whose bookkeeping grows.
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
# Plan, chains, places and one column of 8 bytes at a time; 1 MiB for what malloc keeps in its pockets.
[ $((many - few)) -lt $((4500 * 100 / 1024 + 1024)) ]
