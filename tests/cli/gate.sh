#!/usr/bin/env bash
# gate.sh EPICYCLIC SOURCE_DIR
#
# Special points of the paper's stages are where validation/bifurcation_points has them: those of two small studies, each by
# another method; with WHOLE=yes those of all, the small ones by both methods.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
expected=$2/validation/bifurcation_points

# Those where CVODE finds all points too.
by_cvode=(tang2020_branches_gate tang2020_calibrated_branches_{clearance_0.85,clearance_2.05,damping_2.83})
studies=("${by_cvode[@]:0:2}")
if [ "${WHOLE:-no}" = yes ]; then
  studies=()
  for file in "$expected"/*.json; do studies+=("$(basename -s .json "$file")"); done
fi
[ ${#studies[@]} -ge 1 ] || fail "there are no expected points"
count=0
# By ARKODE, whose steps end on contact changes, and the small ones by CVODE, which knows of none.
for study in "${studies[@]}"; do
  methods=(arkode-dopri5)
  [[ " ${by_cvode[*]} " != *" $study "* ]] || methods+=(cvode-adams)
  if [ "${WHOLE:-no}" != yes ]; then methods=("${methods[count++ % 2]}"); fi
  for method in "${methods[@]}"; do
    tolerance=()
    [ $method = arkode-dopri5 ] || tolerance=(--set /study/tolerance=1e-11)
    what="$study by $method"
    [ "$(code_of "$epicyclic" continue "$inputs/$study.json" -o "$study.$method" --set "/study/method=$method" "${tolerance[@]}")" = 0 ] ||
      fail "$what: $(<stderr)"
    [ "$(code_of "$epicyclic" assert "$study.$method" "$expected/$study.json")" = 0 ] || fail "$what: $(grep -v '^agrees' stdout)$(<stderr)"
    echo "$what: $(tail -n 1 stdout)"
  done
done

# What a wrong model makes of them is seen: a planet whose error is out of phase, as if the program had put it there.
moved=(--set /study/period_max=1 --set /study/method=lanes-cash-karp --set '/stage/lumped/sun_planet_mesh/error_phase_deg=[0, 0, 3]')
[ "$(code_of "$epicyclic" continue "$inputs/tang2020_branches_gate.json" -o moved "${moved[@]}")" = 0 ] || fail "a planet out of phase: $(<stderr)"
[ "$(code_of "$epicyclic" assert moved "$expected/tang2020_branches_gate.json")" = 3 ] || fail "another stage: $(<stdout)"
[ "$(code_of "$epicyclic" assert moved moved.json --record)" = 0 ] || fail "record: $(<stderr)"
{ sed '/^"study":/,$d' "$expected/tang2020_branches_gate.json" && grep '^"study":' moved.json && echo '}'; } >points.json
[ "$(code_of "$epicyclic" assert moved points.json)" = 1 ] || fail "a planet out of phase moves nothing: $(<stdout)$(<stderr)"
grep -q '^agrees' stdout && fail "a point that a planet out of phase does not move: $(<stdout)"

finish
