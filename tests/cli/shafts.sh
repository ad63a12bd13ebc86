#!/usr/bin/env bash
# shafts.sh PROGRAM SOURCE: errors that repeat with a shaft, unlike planets and modes of drive, as a user meets them.
set -uo pipefail
. "$2/tests/cli/common.bash"

cat > stage.json <<'JSON'
{ "name": "shafts", "boundary": "fixed_ring", "load": { "torque_Nm": 600 },
  "planets": { "count": 3, "centre_distance_mm": 71.72084 },
  "lumped": {
    "sun": { "mass_kg": 1.654, "inertia_over_r2_kg": 1.2526, "support_N_per_m": 1e8, "torsional_support_N_per_m": 0,
             "support_damping_ratio": 0.05, "teeth": 27, "base_radius_mm": 32.17853, "eccentricity_um": 10 },
    "ring": { "mass_kg": 4.291, "inertia_over_r2_kg": 5.963, "support_N_per_m": 1e8, "torsional_support_N_per_m": 1e9,
              "support_damping_ratio": 0.05, "teeth": 81, "base_radius_mm": 96.53557 },
    "carrier": { "mass_kg": 7.553, "inertia_over_r2_kg": 7.757, "support_N_per_m": 1e8, "torsional_support_N_per_m": 0,
                 "support_damping_ratio": 0.05 },
    "planet": { "mass_kg": [1.037, 1.1, 1.2], "inertia_over_r2_kg": 0.974, "bearing_N_per_m": [1e8, 1.2e8, 0.9e8],
                "support_damping_ratio": 0.05, "teeth": 25, "base_radius_mm": 29.79493 },
    "sun_planet_mesh": { "stiffness_N_per_m": 1.258e9, "stiffness_cos_N_per_m": [1.5e8], "damping_ratio": 0.05,
                         "backlash_half_um": 40, "error_amplitude_um": 2 },
    "ring_planet_mesh": { "stiffness_N_per_m": 1.316e9, "stiffness_cos_N_per_m": [1.5e8], "damping_ratio": 0.05,
                          "backlash_half_um": 40, "error_amplitude_um": 2 } } }
JSON
cat > run.json <<'JSON'
{ "stage": "stage.json", "operation": { "mesh_frequency_ratio": 0.9 },
  "study": { "kind": "run", "transient_periods": 20, "recorded_periods": 16, "period_max": 4, "exponent_periods": 0,
             "history_periods": 27, "dense_phases": 16 } }
JSON
to_sweep=(--set '/study={"kind":"sweep","from":0.8,"to":0.9,"points":2,"transient_periods":20,"recorded_periods":16}')
plain=(--set /stage/lumped/sun/eccentricity_um=null)

[ "$(code_of "$epicyclic" run run.json -o shafts)" = 0 ] || fail "a run with an eccentric sun: $(cat stderr)"
grep -q 'repeat after 27 mesh periods' shafts/summary.md || fail "the common period is stated"
grep -q 'Periodic: the states repeat after 27 mesh periods' shafts/summary.md || fail "the regime is in mesh periods"
for line in '1/27 (sun)' '1 + 1/27 (sun)' '1 - 1/27 (sun)'; do
  grep -qF "$line" shafts/spectrum.csv || fail "the line $line is named"
done
largest=$(awk -F, '$1 == "delta_sp_1" && $4 > 0 { if ($6 > most) { most = $6; name = $5 } } END { print name }' shafts/spectrum.csv)
[ "$largest" = "1/27 (sun)" ] || [ "$largest" = 1 ] || fail "the largest line is $largest"
"$epicyclic" run run.json -o two --threads 2 >/dev/null 2>&1
for file in points.csv results.h5 spectrum.csv summary.md; do
  cmp -s "shafts/$file" "two/$file" || fail "$file is the same bytes by two threads"
done

[ "$(code_of "$epicyclic" sweep run.json -o no "${to_sweep[@]}")" = 2 ] || fail "a sweep is refused"
grep -q 'repeat after 27 mesh periods' stderr || fail "the reason is stated"
[ ! -e no ] || fail "nothing is written"
[ "$(code_of "$epicyclic" sweep run.json -o plain "${to_sweep[@]}" "${plain[@]}")" = 0 ] || fail "unlike planets sweep: $(cat stderr)"
[ "$(code_of "$epicyclic" gear run.json -o gear)" = 0 ] || fail "gear with an eccentric sun: $(cat stderr)"

# Too long for sections.
[ "$(code_of "$epicyclic" run run.json -o long --set /stage/lumped/planet/eccentricity_um=5 --set /study/history_periods=1 \
  --set /study/transient_periods=1 --set /study/recorded_periods=1 --set /study/spectrum_periods=675 \
  --set /study/dense_phases=8)" = 0 ] || fail "675 mesh periods are integrated: $(cat stderr)"
grep -q 'not sought beyond 128 mesh periods' long/summary.md || fail "no regime is claimed"
grep -q '(planets)' long/spectrum.csv || fail "lines of the planets are named"
[ "$(code_of "$epicyclic" check run.json --set /stage/lumped/sun/pitch_error_um='[1,2,3]')" = 2 ] || fail "3 teeth of 27"
grep -q 'pitch_error_um: has 3 numbers' stderr || fail "the number of teeth is stated"
[ "$(code_of "$epicyclic" check run.json --set /stage/lumped/planet/mass_kg='[1,2]')" = 2 ] || fail "2 masses of 3 planets"
[ "$(code_of "$epicyclic" check run.json --set /stage/lumped/planet/bearing_N_per_m='[1e8,-1,1e8]')" = 2 ] || fail "a negative bearing"

# Modes of drive.
held_sun=(--set /stage/boundary=fixed_sun --set /stage/lumped/ring/torsional_support_N_per_m=0
  --set /stage/lumped/sun/torsional_support_N_per_m=1e9)
[ "$(code_of "$epicyclic" check run.json "${plain[@]}" "${held_sun[@]}")" = 2 ] || fail "a sun that is held does not drive"
grep -q '/driver: must be carrier or ring' stderr || fail "who may drive is stated"
for driver in carrier ring; do
  [ "$(code_of "$epicyclic" sweep run.json -o "held_$driver" "${to_sweep[@]}" "${plain[@]}" "${held_sun[@]}" \
    --set "/stage/driver=$driver")" = 0 ] || fail "the $driver drives: $(cat stderr)"
done
code_of "$epicyclic" check run.json "${plain[@]}" "${held_sun[@]}" --set /stage/driver=ring >/dev/null
grep -q 'the ring drives, the carrier is driven' stdout stderr || fail "check states who drives"
free=(--set /stage/boundary=free --set /stage/lumped/ring/torsional_support_N_per_m=0)
[ "$(code_of "$epicyclic" check run.json "${plain[@]}" "${free[@]}")" = 2 ] || fail "a differential needs its speeds"
[ "$(code_of "$epicyclic" sweep run.json -o free "${to_sweep[@]}" "${plain[@]}" "${free[@]}" \
  --set /stage/carrier_to_sun_speed=-0.5)" = 0 ] || fail "a differential: $(cat stderr)"

finish
