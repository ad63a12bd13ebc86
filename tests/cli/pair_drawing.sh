#!/usr/bin/env bash
# pair_drawing.sh PROGRAM SOURCE: a lone pair of gears from its drawing in every command, and from its computed values.
set -uo pipefail
. "$2/tests/cli/common.bash"
without_drawing
pair=$inputs/pair_from_drawing.json
few=(--set /study/points=4 --set /study/transient_periods=10 --set /study/recorded_periods=16 --set /study/classification_periods=0)

[ "$(code_of "$epicyclic" check "$pair" --no-time)" = 0 ] || fail "check: $(<stderr)"
[ "$(code_of "$epicyclic" gear "$pair" -o gear)" = 0 ] || fail "gear: $(<stderr)"
rows=$(grep -v '^| `/' gear/gear.md | grep -i '\bring\b\|carrier\|planets\|ring_[^f]\|assembl')
[ -z "$rows" ] || fail "gear.md of a pair has a ring: $rows"
for file in geometry stiffness load_sharing friction friction_ratios static_transmission_error modes; do
  [ -s "gear/$file.csv" ] || fail "$file.csv is missing"
done
grep -q '^rp,\|k_rp' gear/*.csv && fail "tables with a ring's mesh: $(grep -l '^rp,\|k_rp' gear/*.csv)"
grep -q '^ring_\|_gap,\|planet_gap' gear/geometry.csv && fail "geometry.csv has a ring's rows"

# The same pair by the values that the drawing gives: the same bytes.
[ "$(code_of "$epicyclic" sweep "$pair" "${few[@]}" -o drawn)" = 0 ] || fail "sweep: $(<stderr)"
[ "$(code_of "$epicyclic" sweep drawn/input.resolved.json --set /stage/catalogue=null -o lumped)" = 0 ] || fail "sweep of the values: $(<stderr)"
grep -q '"catalogue"' lumped/input.resolved.json && fail "the pair of the values has a drawing"
for file in points.csv poincare.csv; do cmp -s "drawn/$file" "lumped/$file" || fail "$file differs from the pair of the values"; done

one=(--set '/study={"kind":"run","transient":"fixed","transient_periods":5,"recorded_periods":16,"exponent_periods":0,"spectrum_periods":16,"history_periods":2,"check_tolerance":1e-6}')
[ "$(code_of "$epicyclic" run "$pair" "${one[@]}" -o run)" = 0 ] || fail "run: $(<stderr)"
branch=(--set '/study={"kind":"continue","from":0.9,"to":0.95,"period_max":1,"orbits":2,"branches":1,"transient_periods":40,"tolerance":1e-7}')
[ "$(code_of "$epicyclic" continue "$pair" "${branch[@]}" -o branch)" = 0 ] || fail "continue: $(<stderr)"

# With bearings by designation the gears move, and both bearings have a life.
held=(--set '/stage/catalogue/sun_bearing={"type":"6208"}' --set '/stage/catalogue/planet_bearing={"type":"NU210"}'
  --set /stage/lumped/sun/support_damping_ratio=0.03 --set /stage/lumped/planet/support_damping_ratio=0.03)
[ "$(code_of "$epicyclic" sweep "$pair" "${few[@]}" "${held[@]}" -o held)" = 0 ] || fail "sweep with bearings: $(<stderr)"
head -1 held/points.csv | grep -q 'sun_bearing_life_h' || fail "no life of gear 1's bearing: $(head -1 held/points.csv)"
head -1 held/points.csv | grep -q 'bearing_1_life_h' || fail "no life of gear 2's bearing"

refused() {
  [ "$(code_of "$epicyclic" "$@")" = 2 ] || fail "exit code of $*: $(<stderr)"
}
told() { grep -qF "$1" stderr || fail "not told of $1: $(<stderr)"; }
refused check "$pair" --set '/stage/catalogue/ring={"teeth":98,"module_mm":4,"width_mm":30}'
told '/stage/catalogue/ring: must be left out: a pair has gear 1 (sun) and gear 2 (planet) alone'
refused check "$pair" --set /stage/catalogue/planet=null
told '/stage/catalogue/planet'
refused check "$pair" --set /stage/catalogue/planet/module_mm=5
told 'base pitches of both gears differ'
refused check "$pair" --set /stage/catalogue/sun_bearing='{"type":"6208"}'
told '/stage/lumped/planet/bearing_N_per_m'
refused check "$pair" --set /stage/boundary=fixed_ring --set '/stage/planets={"count":3}'
told '/stage/catalogue/ring: is missing'
finish
