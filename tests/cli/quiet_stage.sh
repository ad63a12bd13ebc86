#!/usr/bin/env bash
# quiet_stage.sh EPICYCLIC SOURCE_DIR
#
# A stage that nothing excites: constant stiffness, no errors. Each command ends with 0. A figure that has nothing to draw, as
# the spectra of a motion without vibration, is said and is no failure, neither now nor when the folder is found complete.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

cat >quiet.json <<'END'
{ "name": "quiet", "boundary": "fixed_ring", "planets": { "count": 3, "centre_distance_mm": 53 }, "load": { "torque_Nm": 500 },
  "lumped": {
    "sun": { "mass_kg": 0.4, "inertia_over_r2_kg": 0.39, "support_N_per_m": 1e8, "torsional_support_N_per_m": 0, "teeth": 27,
             "base_radius_mm": 24, "support_damping_ratio": 0.05, "bearing_clearance_half_um": 0 },
    "ring": { "mass_kg": 2.35, "inertia_over_r2_kg": 3.0, "support_N_per_m": 1e8, "torsional_support_N_per_m": 1e9, "teeth": 81,
              "base_radius_mm": 72, "support_damping_ratio": 0.05 },
    "carrier": { "mass_kg": 5.43, "inertia_over_r2_kg": 6.29, "support_N_per_m": 1e8, "torsional_support_N_per_m": 0,
                 "support_damping_ratio": 0.05 },
    "planet": { "mass_kg": 0.66, "inertia_over_r2_kg": 0.61, "bearing_N_per_m": 1e8, "teeth": 27, "base_radius_mm": 24,
                "support_damping_ratio": 0.05 },
    "sun_planet_mesh": { "stiffness_N_per_m": 5e8, "operating_pressure_angle_deg": 25.0876278415116, "damping_ratio": 0.05,
                         "backlash_half_um": 10, "error_amplitude_um": 0, "error_phase_deg": 0 },
    "ring_planet_mesh": { "stiffness_N_per_m": 5e8, "operating_pressure_angle_deg": 25.0876278415116, "damping_ratio": 0.05,
                          "backlash_half_um": 10, "error_amplitude_um": 0, "error_phase_deg": 0 } } }
END
# $1: the command, $2: its study.
study() {
  printf '{ "stage": "quiet.json", "operation": { "mesh_frequency_ratio": 1.0 }, "study": { "kind": "%s", %s } }\n' "$1" "$2" >"$1.json"
}
speeds='"parameter": "mesh_frequency_ratio", "from": 0.8, "to": 1.2'
study sweep "$speeds, \"points\": 3, \"directions\": [\"up\"], \"transient_periods\": 300, \"recorded_periods\": 32"
study run '"exponent_periods": 10, "transient_periods": 200'
study continue "$speeds, \"starts\": [1.0]"
study map '"first": { "parameter": "mesh_frequency_ratio", "from": 0.9, "to": 1.1, "points": 3 },
  "second": { "parameter": "damping_ratio", "from": 0.03, "to": 0.05, "points": 2 }, "transient_periods": 200'
study crosscheck '"from": 0.9, "to": 1.1, "points": 2, "transient_periods": 200'
cp quiet.json gear.json
for command in sweep run continue map crosscheck gear; do
  for time in first second; do
    [ "$(code_of "$epicyclic" $command $command.json -o $command)" = 0 ] || fail "$command, the $time time: $(<stderr)"
    [ $command.$time != sweep.first ] || grep -q 'waterfall_delta_sp_up.png was not drawn: there is no value to draw' stderr ||
      fail "that there is no spectrum is not said: $(<stderr)"
  done
done
finish
