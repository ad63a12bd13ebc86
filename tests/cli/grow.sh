#!/usr/bin/env bash
# grow.sh EPICYCLIC SOURCE_DIR
#
# A study that grows from a smaller one by --grow is, file by file, the one that is computed afresh: more points, a wider range,
# another direction, segments, maps; and where nothing can be taken it is refused with the reason.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

common=("$inputs/tang2020_speed.json" --set /study/crosscheck/points=0 --set /study/transient_periods=40 --set /study/recorded_periods=16
  --set /study/classification_periods=200 --set /study/from=2)
# sweep FOLDER ARGUMENTS...
sweep() { "$epicyclic" sweep "${common[@]}" -o "$@" >out 2>err || fail "sweep $*: $(<err)"; }
# grown FRESH TAKEN SMALL ARGUMENTS...: that many points are those of SMALL, and all files are those of FRESH.
grown() {
  local fresh=$1 taken=$2 small=$3
  sweep "$fresh" "${@:4}"
  cp -r "$small" before
  sweep "$fresh.grown" "${@:4}" --grow "$small"
  grep -q ": $taken of [0-9]* points are those of $small" err || fail "$fresh: $(<err)"
  for file in points.csv poincare.csv results.h5 input.resolved.json figures/bifurcation_delta_sp.dat figures/response_delta_sp.dat; do
    cmp "$fresh/$file" "$fresh.grown/$file" || fail "$fresh: $file"
  done
  grep -q "\"taken\": $taken" "$fresh.grown/run.json" || fail "$fresh: run.json does not say what was taken"
  diff -r "$small" before >/dev/null || fail "$fresh: the smaller study was changed"
  rm -r before
}
cold=(--set /study/start=cold '--set' '/study/directions=["up"]')
up=(--set /study/segments=1 --set '/study/directions=["up"]')
both=(--set /study/segments=1 --set '/study/directions=["down", "up"]')
sweep cold3 "${cold[@]}" --set /study/to=2.2 --set /study/points=3
grown cold7 3 cold3 "${cold[@]}" --set /study/to=2.3 --set /study/points=7
sweep up3 "${up[@]}" --set /study/to=2.2 --set /study/points=3
grown up5 3 up3 "${up[@]}" --set /study/to=2.4 --set /study/points=5
grown both3 3 up3 "${both[@]}" --set /study/to=2.2 --set /study/points=3
sweep segments4 --set '/study/directions=["up"]' --set /study/segments=2 --set /study/to=2.3 --set /study/points=4
grown segments6 4 segments4 --set '/study/directions=["up"]' --set /study/segments=3 --set /study/to=2.5 --set /study/points=6

# A map, line by line; after a kill the same command goes on.
map() { "$epicyclic" map "$inputs/tang2020_map.json" -o "$@" --set /study/transient_periods=40 --set /study/recorded_periods=16 --set /study/classification_periods=0; }
map small --set /study/first/points=2 --set /study/first/from=2 --set /study/first/to=2.1 --set /study/second/points=2 >out 2>err || fail "map: $(<err)"
larger=(--set /study/first/points=3 --set /study/first/from=2 --set /study/first/to=2.2 --set /study/second/points=3)
map large "${larger[@]}" >out 2>err || fail "map: $(<err)"
map large.grown "${larger[@]}" --grow small >out 2>err || fail "grown map: $(<err)"
grep -q ': 4 of 9 cells are those of small' err || fail "the map: $(<err)"
for file in points.csv results.h5; do cmp "large/$file" "large.grown/$file" || fail "the map: $file"; done

refused() {
  [ "$(code_of "$epicyclic" "$@" -o refused)" = 2 ] || fail "exit code of $*: $(<stderr)"
  [ ! -e refused ] || fail "$* left a folder"
}
refused sweep "${common[@]}" "${up[@]}" --set /study/to=2.2 --set /study/points=3 --set /study/recorded_periods=32 --grow up3
grep -q '/study/recorded_periods: 16 there, 32 here' stderr || fail "the reason: $(<stderr)"
refused sweep "${common[@]}" "${up[@]}" --set /study/from=1.9 --set /study/to=2.2 --set /study/points=4 --grow up3
grep -q 'this study has none of its points' stderr || fail "the reason: $(<stderr)"
refused sweep "${common[@]}" "${up[@]}" --set /integrator/relative_tolerance=1e-9 --set /study/to=2.4 --set /study/points=5 --grow up3
refused sweep "${common[@]}" "${up[@]}" --set /study/to=2.4 --set /study/points=5 --grow small
refused sweep "${common[@]}" "${up[@]}" --set /study/to=2.4 --set /study/points=5 --grow nowhere
printf x >>up3/journal.bin
"$epicyclic" sweep "${common[@]}" "${up[@]}" --set /study/to=2.4 --set /study/points=5 --grow up3 -o after >out 2>err || fail "a torn tail: $(<err)"
cmp after/points.csv up5/points.csv || fail "a torn tail: points.csv"
finish
