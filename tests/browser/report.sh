#!/usr/bin/env bash
# report.sh EPICYCLIC SOURCE_DIR
#
# Pages of `report` in a headless Chromium, as report.mjs reads them. Skipped where Chromium or Node.js is missing.
set -euo pipefail
source "$2/tests/cli/common.bash"
source "$2/tests/browser/browser.bash"
source "$2/tests/cli/report_studies.bash"

mkdir pages
reported() {
  local name=$1
  shift
  "$epicyclic" report "$@" -o "pages/$name.html" >/dev/null 2>stderr || fail "the report $name: $(<stderr)"
}
make_studies
reported sweep sweep
reported both sweep branches
study sweep "$inputs/tang2020_calibrated_speed.json" -o torus --set /study/from=2.6 --set /study/to=2.62 --set /study/points=3 \
  --set '/study/directions=["up"]' --set /study/crosscheck/points=0
reported torus torus
study ramp "$inputs/tang2020_ramp.json" -o ramp --set /study/from=0.8 --set /study/to=0.9 --set /study/hold_periods=20
reported ramp ramp
reported map map
reported basins basins
reported run run
reported gear gear
reported unfinished unfinished
reported hostile hostile
node "$2/tests/browser/report.mjs" "$chromium" "$work/pages" || fail "the pages"
finish
