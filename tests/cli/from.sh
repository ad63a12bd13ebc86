#!/usr/bin/env bash
# from.sh EPICYCLIC SOURCE_DIR
#
# From a diagram to one motion: `run`, `crosscheck` and `tolerance` with --from, on either branch of a hysteresis, with and
# without INPUT; what else is known there; points of maps, of basins and of sweeps that change the time scale; bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

# Between two folds, at 0.8834 and 0.8923, two motions of period 1 are stable.
"$epicyclic" sweep "$inputs/tang2020_calibrated_speed.json" -o sweep --set /study/from=0.88 --set /study/to=0.9 --set /study/points=3 \
  --set /study/crosscheck/points=0 >/dev/null 2>&1 || fail "the sweep"
cp -r sweep before

# value COLUMN FOLDER [ROW]: of points.csv.
value() {
  awk -F, -v column="$1" -v row="${3:-0}" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == column) at = k } NR == row + 2 { print $at }' "$2/points.csv"
}
# near X Y RELATIVE
near() { awk -v x="$1" -v y="$2" -v e="$3" 'BEGIN { d = x - y; if (d < 0) d = -d; exit !(d <= e * (x < 0 ? -x : x)) }'; }
brief=(--set /study/exponent_periods=0 --set /study/spectrum_periods=8 --set /study/history_periods=8)

for way in up down; do
  row=$([ $way = up ] && echo 1 || echo 4)
  [ "$(code_of "$epicyclic" run --from "sweep:$way=0.889" -o "run_$way" "${brief[@]}")" = 0 ] || fail "run $way: $(<stderr)"
  near "$(value delta_sp_max "run_$way")" "$(value delta_sp_max sweep $row)" 1e-6 || fail "run $way is on another branch"
  grep -q "point $row ($way, mesh_frequency_ratio = 0.89, sun [0-9.]* rpm), period 1" stderr || fail "run $way: where it starts: $(<stderr)"
  grep -q "coexists there: point $((5 - row)) ($([ $way = up ] && echo down || echo up), " stderr || fail "run $way: the other branch"
  tr '\n' ' ' <"run_$way/summary.md" | grep -q "Start: point $row .*coexists there: point" || fail "run $way: summary.md"
done
near "$(value delta_sp_max run_up)" "$(value delta_sp_max run_down)" 0.01 && fail "the two branches are one"
diff -r sweep before >/dev/null || fail "the donor was changed"

# An index is as good; the same bytes by any number of threads; the resolved input needs no donor.
[ "$(code_of "$epicyclic" run --from sweep:4 -o again --threads 1 "${brief[@]}" --set /study/exponent_periods=20 --set /study/check_tolerance=1e-6)" = 0 ] || fail "$(<stderr)"
[ "$(code_of "$epicyclic" run again/input.resolved.json -o alone --threads 2)" = 0 ] || fail "resolved: $(<stderr)"
for file in points.csv history.csv spectrum.csv exponents.csv multipliers.csv results.h5 input.resolved.json; do
  cmp "again/$file" "alone/$file" || fail "resolved: $file"
done
near "$(value delta_sp_max again)" "$(value delta_sp_max run_down)" 1e-9 || fail "by index"

# An INPUT of one's own, or another speed: the state is a start alone, and that is said.
[ "$(code_of "$epicyclic" run "$inputs/tang2020_run.json" --from sweep:4 -o own "${brief[@]}")" = 0 ] || fail "own: $(<stderr)"
grep -q 'not those of this study' stderr || fail "own equations: $(<stderr)"
[ "$(value value own)" = 1.3 ] || fail "own speed"
[ "$(code_of "$epicyclic" run --from sweep:4 -o nudged "${brief[@]}" --set /operation/mesh_frequency_ratio=0.8905)" = 0 ] || fail "nudged"
grep -q 'not those of this study' stderr || fail "nudged: $(<stderr)"
near "$(value delta_sp_max nudged)" "$(value delta_sp_max run_down)" 0.01 || fail "nudged onto another branch"

# Other commands.
[ "$(code_of "$epicyclic" crosscheck --from sweep:down=0.89 -o check --threads 2 --set '/study/methods=["arkode-dopri5", "cvode-adams", "cvode-bdf"]')" = 0 ] || fail "crosscheck: $(<stderr)"
[ "$(grep -c ',agree,' check/crosscheck.csv)" = 2 ] || fail "crosscheck: methods on two branches: $(<check/crosscheck.csv)"
near "$(value delta_sp_max check)" "$(value delta_sp_max run_down)" 1e-5 || fail "crosscheck: on another branch"
[ "$(code_of "$epicyclic" crosscheck --from run_down:0 -o of_run --threads 2 --set '/study/methods=["arkode-dopri5"]')" = 0 ] || fail "crosscheck of a run: $(<stderr)"
grep -q -- '^--from run_down:0: the run at mesh_frequency_ratio = 0.89, sun [0-9.]* rpm, period 1$' stderr || fail "crosscheck of a run: where it starts: $(<stderr)"
[ "$(code_of "$epicyclic" tolerance --from sweep:down=0.89 -o accuracy --threads 2 --set '/study/methods=["arkode-dopri5"]')" = 0 ] ||
  fail "tolerance: $(<stderr)"
near "$(value delta_sp_max accuracy)" "$(value delta_sp_max run_down)" 1e-5 || fail "tolerance: on another branch"

# At a speed that is set, and one that is told in rpm.
[ "$(code_of "$epicyclic" crosscheck --from sweep:4 -o faster --threads 2 --set /operation/mesh_frequency_ratio=0.895 --set '/study/methods=["arkode-dopri5"]')" = 0 ] ||
  fail "crosscheck at another speed: $(<stderr)"
[ "$(value value faster)" = 0.895 ] || fail "crosscheck at another speed: $(value value faster)"
rpm=$(value sun_speed_rpm sweep 4)
[ "$(code_of "$epicyclic" run --from "sweep:down=${rpm}rpm" -o by_rpm "${brief[@]}")" = 0 ] || fail "by rpm: $(<stderr)"
grep -q 'point 4 (down' stderr || fail "by rpm: $(<stderr)"

# With another stage a study in rpm stays at its speed, from a point and from a resolved input.
heavier=(--set /stage/lumped/sun/inertia_over_r2_kg=3)
"$epicyclic" sweep "$inputs/tang2020_calibrated_speed.json" -o in_rpm --set /study/parameter=sun_speed_rpm --set /study/from=20000 \
  --set /study/to=21000 --set /study/points=2 --set /study/crosscheck/points=0 --set /study/transient_periods=20 \
  --set /study/recorded_periods=16 --set /study/classification_periods=0 >out 2>&1 || fail "a sweep in rpm: $(<out)"
[ "$(code_of "$epicyclic" run --from in_rpm:1 -o heavier "${brief[@]}" "${heavier[@]}")" = 0 ] || fail "a heavier sun: $(<stderr)"
[ "$(code_of "$epicyclic" run heavier/input.resolved.json -o lighter --set /stage/lumped/sun/inertia_over_r2_kg=2)" = 0 ] || fail "a lighter sun: $(<stderr)"
for run in heavier lighter; do near "$(value sun_speed_rpm $run)" 21000 1e-9 || fail "$run: $(value sun_speed_rpm $run) rpm"; done

# Points whose record has not settled, or is shorter than the motion's period.
"$epicyclic" sweep "$inputs/tang2020_calibrated_speed.json" -o unsettled --set /study/from=0.3 --set /study/to=0.9 --set /study/points=3 \
  --set /study/crosscheck/points=0 --set /study/transient_periods=40 --set /study/recorded_periods=16 >out 2>&1 || fail "the unsettled sweep"
grep -q 'points whose record has not converged to the orbit' out || fail "an unsettled record is not told: $(<out)"
for point in 0 2 4; do
  [ "$(code_of "$epicyclic" run --from unsettled:$point -o "settled$point" "${brief[@]}")" = 0 ] || fail "unsettled:$point: $(<stderr)"
done

# A map's cell, and a parameter that changes the scale of time: Omega is another number for the same speed.
"$epicyclic" map "$inputs/tang2020_map.json" -o map --set /study/first/points=2 --set /study/second/points=2 --set /study/transient_periods=50 \
  --set '/stage="'"$inputs"'/tang2020_calibrated.json"' --set /study/first/from=1 --set /study/first/to=1.05 >/dev/null 2>&1 || fail "the map"
[ "$(code_of "$epicyclic" run --from map:3 -o of_map "${brief[@]}")" = 0 ] || fail "of a map: $(<stderr)"
near "$(value delta_sp_max of_map)" "$(value delta_sp_max map 3)" 1e-4 || fail "of a map: another motion"
bore=/stage/catalogue/planet/bore_mm
"$epicyclic" sweep "$inputs/tang2020_calibrated_speed.json" -o bore --set /study/parameter=$bore --set /study/from=30 --set /study/to=36 \
  --set /study/points=2 --set '/study/directions=["up"]' --set /operation/mesh_frequency_ratio=0.85 --set /study/crosscheck/points=0 >/dev/null 2>&1 ||
  fail "the sweep over a bore"
[ "$(code_of "$epicyclic" run --from bore:1 -o of_bore "${brief[@]}")" = 0 ] || fail "of a bore: $(<stderr)"
grep -q 'not those of this study' stderr && fail "of a bore: $(<stderr)"
near "$(value mesh_frequency_Hz of_bore)" "$(value mesh_frequency_Hz bore 1)" 1e-12 || fail "of a bore: another speed"
[ "$(value value of_bore)" != 0.85 ] || fail "of a bore: the scale of time did not change"
near "$(value delta_sp_max of_bore)" "$(value delta_sp_max bore 1)" 1e-6 || fail "of a bore: another motion"
[ "$(code_of "$epicyclic" run --from bore:1 -o damped "${brief[@]}" --set /stage/lumped/sun_planet_mesh/damping_ratio=0.3)" = 0 ] || fail "damped: $(<stderr)"
grep -q 'not those of this study' stderr || fail "other equations in another scale of time are not told: $(<stderr)"
mv bore/journal.bin kept
[ "$(code_of "$epicyclic" run --from bore:1 -o refused)" = 7 ] || fail "no journal: $(<stderr)"
mv kept bore/journal.bin

[ "$(code_of "$epicyclic" run --from sweep:9000 -o refused)" = 2 ] || fail "a number too large: $(<stderr)"
grep -q 'there is no point 9000; the study has [0-9]* points, numbered from 0; FOLDER:up=VALUE' stderr || fail "a number too large: $(<stderr)"

# Basins: every attractor that is known.
"$epicyclic" basins "$inputs/tang2020_basins.json" -o basins --set /study/first/points=2 --set /study/first/to=-1.33333333333 \
  --set /study/second/points=2 --set /study/second/to=-1.33333333333 >/dev/null 2>&1 ||
  fail "the basins"
[ "$(code_of "$epicyclic" run --from basins:1 -o of_basins "${brief[@]}")" = 0 ] || fail "of basins: $(<stderr)"
grep -q 'coexists there: .* of 4 cells' stderr || fail "of basins: $(<stderr)"

# A speed as the sweep gives it, without a unit.
few=(--set /study/transient_periods=2 --set /study/recorded_periods=8 --set /study/classification_periods=0 --set /study/crosscheck/points=0)
"$epicyclic" sweep "$inputs/tang2020_speed.json" "${few[@]}" --set /study/parameter=sun_speed_rpm --set /study/from=4000 \
  --set /study/to=30000 --set /study/points=3 -o rpm >/dev/null 2>&1 || fail "the sweep in rpm"
for speed in 17000 17000rpm 0.75; do
  code_of "$epicyclic" crosscheck --from "rpm:up=$speed" -o "at_$speed" --set '/study/methods=["cvode-adams"]' >/dev/null
  grep -q 'point 1 (up, .*, sun 17000 rpm)' stderr || fail "$speed is another point: $(<stderr)"
done

refused() {
  [ "$(code_of "$@" -o refused)" = 2 ] || fail "exit code of $*: $(<stderr)"
  [ "$(wc -l <stderr)" -le 2 ] || fail "$*: $(<stderr)"
  [ ! -e refused ] || fail "$* left a folder"
}
refused "$epicyclic" run
refused "$epicyclic" run --from sweep
refused "$epicyclic" run --from sweep:6
refused "$epicyclic" run --from sweep:up=0.5
refused "$epicyclic" run --from sweep:up=
refused "$epicyclic" run --from sweep:up=nan
refused "$epicyclic" run --from map:up=1
refused "$epicyclic" run --from nowhere:1
refused "$epicyclic" run --from "$inputs:1"
refused "$epicyclic" run --from sweep:1 --from sweep:2
refused "$epicyclic" run "$inputs/lin_parker_1999_n3.json" --from sweep:1
refused "$epicyclic" run "$inputs/tang2020_run.json" --set '/study/initial_state=[1, 2]'
refused "$epicyclic" sweep "$inputs/tang2020_speed.json" --set /study/parameter=/study/initial_state/3
printf 'x' >>sweep/input.resolved.json
[ "$(code_of "$epicyclic" run --from sweep:1 -o refused)" = 7 ] || fail "a changed donor: $(<stderr)"
finish
