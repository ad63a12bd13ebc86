#!/usr/bin/env bash
# equations.sh EPICYCLIC SOURCE_DIR PACKAGE_DIR
#
# The equations of motion in Octave, by ode45 beside a section of the program; what is refused; memory. Skipped (77) without
# Octave.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"

command -v octave-cli >/dev/null || skip "no Octave"
without_drawing
"$epicyclic" sweep "${speeds[@]}" -o out --set /study/from=2.8 --set /study/to=2.8 --set /study/points=1 \
  --set '/study/directions=["up"]' --set /study/recorded_periods=16 --set /study/classification_periods=0 >log 2>&1 ||
  fail "the sweep: $(<log)"

octave-cli --quiet --no-history --norc --eval "addpath('$3'); addpath('$here'); equations('$inputs/tang2020_run.json')" \
  >stdout 2>stderr || fail "exit $?: $(<stderr)"
grep -q '^all equal$' stdout || fail "the test did not reach its end: $(tail -n 5 stdout)"
finish
