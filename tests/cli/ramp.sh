#!/usr/bin/env bash
# ramp.sh EPICYCLIC SOURCE_DIR
#
# Run-up and run-down: files and figures, same bytes at 1, 2 and 8 threads and after a stop, torque from a file, refusals.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

result_files=(ramp.csv orders.csv ramp.md results.h5 input.json input.resolved.json figures/campbell_up.dat)
cat >pair.json <<'END'
{ "stage": {
    "boundary": "pair", "planets": { "count": 1 }, "load": { "torque_Nm": 100 },
    "lumped": {
      "sun": { "teeth": 50, "base_radius_mm": 70.477, "mass_kg": 2.8, "inertia_over_r2_kg": 1.6,
               "support_N_per_m": "rigid", "torsional_support_N_per_m": 0 },
      "planet": { "teeth": 50, "base_radius_mm": 70.477, "mass_kg": 2.8, "inertia_over_r2_kg": 1.6, "bearing_N_per_m": "rigid" },
      "sun_planet_mesh": { "stiffness_N_per_m": 4e8, "stiffness_cos_N_per_m": [8e7], "operating_pressure_angle_deg": 20,
                           "damping_ratio": 0.03, "backlash_half_um": 50, "error_amplitude_um": 1 } } },
  "study": { "kind": "ramp", "from": 0.5, "to": 1.0, "rate_per_tau": 1e-3, "hold_periods": 20 } }
END
ramp() { "$epicyclic" ramp pair.json "$@"; }

for threads in 1 2 8; do
  [ "$(code_of ramp -o "t$threads" --threads "$threads")" = 0 ] || fail "ramp with $threads threads: $(<stderr)"
  [ "$threads" != 1 ] || without_drawing
done
same_results t1 t2
same_results t1 t8
for figure in response orders campbell_up campbell_down; do [ -s "t1/figures/$figure.png" ] || fail "figures/$figure.png is missing"; done
[ ! -e t1/journal.bin ] || fail "a complete ramp keeps its journal"
grep -q "Regimes are not claimed" t1/ramp.md || fail "ramp.md says nothing of regimes"
before=$(sha256sum t1/ramp.csv t1/run.json)
[ "$(code_of ramp -o t1)" = 0 ] || fail "a complete folder must give exit 0"
[ "$before" = "$(sha256sum t1/ramp.csv t1/run.json)" ] || fail "a complete folder was changed"

# A resolved input is the study, and a stop is resumed with the same bytes.
[ "$(code_of "$epicyclic" ramp t1/input.resolved.json -o again)" = 0 ] || fail "the resolved input: $(<stderr)"
cmp -s t1/ramp.csv again/ramp.csv || fail "the resolved input gives another ramp"
slow=(--set /study/rate_per_tau=2e-5)
[ "$(code_of ramp "${slow[@]}" -o slow)" = 0 ] || fail "slow: $(<stderr)"
for _ in 1 2 3; do
  timeout -s KILL 0.3 "$epicyclic" ramp pair.json "${slow[@]}" -o killed >/dev/null 2>&1 || true
done
[ "$(code_of ramp "${slow[@]}" -o killed)" = 0 ] || fail "resume: $(<stderr)"
same_results slow killed

# A torque over time.
printf 'time_s,torque_Nm\r\n0,100\r\n0.05,150\r\n' >torque.csv
[ "$(code_of ramp -o file --set /study/torque_file=torque.csv)" = 0 ] || fail "torque_file: $(<stderr)"
[ "$(code_of ramp -o rows --set /study/torque_time_s='[0, 0.05]' --set /study/torque_Nm='[100, 150]')" = 0 ] || fail "torque_Nm: $(<stderr)"
cmp -s file/ramp.csv rows/ramp.csv || fail "a torque from a file gives another ramp"
! cmp -s file/ramp.csv t1/ramp.csv || fail "a torque over time changes nothing"

# Refusals: exit 2, the reason, nothing written.
refused() {
  local reason=$1
  shift
  [ "$(code_of ramp -o none "$@")" = 2 ] || fail "not refused: $*"
  grep -qF "$reason" stderr || fail "$*: no '$reason' in: $(<stderr)"
  [ ! -e none ] || fail "$* left a folder"
}
refused "must rise from" --set /study/to=0.4
refused "exclude each other" --set /study/from_sun_speed_rpm=100
refused "more mesh periods than the whole ramp" --set /study/rate_per_tau=1
refused "the rate is too low" --set /study/rate_per_tau=1e-12
refused "cannot follow a speed that changes" --set /integrator/method=cvode-bdf
refused "must be < half of output_phases" --set /study/orders=40
refused "must rise" --set '/study/torque_time_s=[0, 0]' --set '/study/torque_Nm=[1, 2]'
refused "has 1 numbers" --set '/study/torque_time_s=[0, 1]' --set '/study/torque_Nm=[1]'
refused "no such file" --set /study/torque_file=nowhere.csv
printf 'time_s,force\n0,1\n' >wrong.csv
refused "has no column 'torque_Nm'" --set /study/torque_file=wrong.csv
printf 'time_s,torque_Nm\n0,1\n1,much\n' >words.csv
refused "words.csv: row 2: 'much' in the column 'torque_Nm' is no number" --set /study/torque_file=words.csv
refused "take these out" --set /study/torque_file=torque.csv --set '/study/torque_Nm=[1]' --set '/study/torque_time_s=[1]'
refused "needs a load by torque_Nm" --set '/stage/load={"power_kW": 3}' --set /study/torque_file=torque.csv
refused "spur gears that move in their plane" --set /stage/lumped/sun/helix_angle_deg=0
[ "$(code_of "$epicyclic" init helical --helix-angle 15)" = 2 ] || fail "init takes a helix angle"
grep -qF "spur gears that move in their plane" stderr || fail "init does not say why it refuses a helix angle"
[ ! -e helical ] || fail "init with a helix angle left a folder"

# A clearance and a life of planet bearings.
"$epicyclic" init set --teeth 21,28,77 --module 3 --width 30 --torque 480 --speed 3000 >stdout 2>stderr || fail "init: $(<stderr)"
life=(run set/point.json --set /study/exponent_periods=0 --set /stage/lumped/planet/bearing_clearance_half_um=15
  --set '/stage/lumped/planet/bearing={"dynamic_load_rating_kN": 30}')
[ "$(code_of "$epicyclic" "${life[@]}" -o life)" = 0 ] || fail "life: $(<stderr)"
head -n 1 life/points.csv | grep -q 'bearing_life_min_h,bearing_1_load_N,bearing_1_life_Mrev,bearing_1_life_h' || fail "no columns of lives"
finish
