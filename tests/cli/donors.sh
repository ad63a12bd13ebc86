#!/usr/bin/env bash
# donors.sh EPICYCLIC SOURCE_DIR SHIM
#
# Each kind of finished folder, at each regime, given to each command that takes one: --from of `run`, `crosscheck`,
# `tolerance` and `continue`, --grow, --against, `assert` and `plot`. A command takes it, or refuses it with 2 and a reason.
# A run.json that was changed is refused, too. What the machine cannot read is no verdict (tests/faults/shim.cpp).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

short=(--set /study/transient=fixed --set /study/transient_periods=64 --set /study/recorded_periods=16)
# What gives each donor its regime, and little to compute. A torus needs more periods than others.
cheap=(--set /integrator/relative_tolerance=1e-6 --set /integrator/absolute_tolerance=1e-8 --set /study/output_phases=8 --set /study/classification_periods=1200)
brief=(--set /study/exponent_periods=0 --set /study/spectrum_periods=8 --set /study/history_periods=8)
soon=(--set /study/classification_periods=256) # of what is computed from a donor, whatever its regime
plus() { awk -v x="$1" -v d="$2" 'BEGIN { printf "%.9f\n", x + d }'; }

# make NAME SPEED [OPTION ...]: a run, a sweep and a map whose point 0 is at that speed. Point 1 of the sweep is at
# `other`, or next to it.
donors=()
make() {
  local name=$1 speed=$2 ends next
  shift 2
  code_of "$epicyclic" run "$inputs/tang2020_run.json" -o "run_$name" --set "/operation/mesh_frequency_ratio=$speed" "${short[@]}" "${cheap[@]}" "${brief[@]}" "$@" >code
  next=$(plus "$speed" 1e-6)
  ends=(from="$speed" to="${other:-$next}" points=2)
  code_of "$epicyclic" sweep "$inputs/tang2020_speed.json" -o "sweep_$name" "${ends[@]/#/--set=/study/}" "${short[@]}" "${cheap[@]}" --set /study/crosscheck/points=0 "$@" >>code
  ends[1]=to=$next
  code_of "$epicyclic" map "$inputs/tang2020_map.json" -o "map_$name" "${ends[@]/#/--set=/study/first/}" --set=/study/second/points=2 "${short[@]}" "${cheap[@]}" "$@" >>code
  grep -qv '[01]' code && fail "the donors $name: $(<code) $(<stderr)"
  donors+=("$name:$speed")
}
make one 2.8
make two 2.1016949
other=2.8 make torus 2.0457627 --set /study/classification_periods=3584
make chaos 1.3
make undecided 1.3 --set /study/classification_periods=0
make unsettled 2.8 --set /study/transient_periods=0 --set /study/recorded_periods=8
make recurrent 2.8 --set /model/gap_damping=contact_slope --set /study/transient_periods=800 --set /study/recurrence_tolerance=0.05
make none 2.8 --set /integrator/max_steps_per_period=10

# told FOLDER: status and regime of its point 0.
told() {
  awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) name[$k] = k } NR == 2 { print $name["status"], $name["regime"], $name["period"] }' "$1/points.csv"
}
for expected in 'one:ok periodic 1' 'two:ok periodic 2' 'torus:ok quasiperiodic 0' 'chaos:ok chaotic 0' 'undecided:ok undecided 0' \
  'unsettled:ok periodic 1' 'recurrent:ok periodic 1' 'none:step_limit  0'; do
  [ "$(told "run_${expected%%:*}")" = "${expected#*:}" ] || fail "the donor ${expected%%:*} is not what it is to be: $(told "run_${expected%%:*}")"
done

# takes CODES COMMAND ...: ends with one of these; what is refused is refused in a line or two, and leaves no folder.
takes() {
  local allowed=$1 code
  shift
  rm -rf taken
  code=$(code_of "$@" -o taken)
  case " $allowed " in *" $code "*) ;; *) fail "$code of $*: $(<stderr)" ;; esac
  [ "$code" != 2 ] || [ ! -e taken ] || fail "$* was refused and left a folder"
  [ "$code" != 2 ] || [ -s stderr ] || fail "$* was refused without a word"
}
methods=(--set '/study/methods=["arkode-dopri5"]')
tolerances=(--set '/study/tolerances=[1e-5]' --set /study/reference_tolerance=1e-7 --set /study/chaotic_periods=64)
for donor in "${donors[@]}"; do
  name=${donor%:*} speed=${donor#*:}
  [ "$name" = none ] && codes=2 || codes='0 1'
  for kind in run sweep map; do
    from="${kind}_$name:0"
    takes "$codes" "$epicyclic" run --from "$from" "${brief[@]}" "${soon[@]}"
    takes "$codes" "$epicyclic" crosscheck --from "$from" "${methods[@]}"
    takes "$codes" "$epicyclic" tolerance --from "$from" "${methods[@]}" "${tolerances[@]}" "${soon[@]}"
    # Of no periodic motion there may be no orbit near it, which is a result, and no branch.
    near=(from="$(plus "$speed" -1e-4)" to="$(plus "$speed" 1e-4)" starts=[] largest_period=2 tolerance=1e-6 output_phases=8 orbits=4)
    takes "$codes" "$epicyclic" continue "$inputs/tang2020_branches.json" --from "$from" "${near[@]/#/--set=/study/}"
  done
done
takes 0 "$epicyclic" run --from run_one:0 "${brief[@]}"
[ "$(told taken)" = 'ok periodic 1' ] || fail "a run from a periodic run: $(told taken)"

# Kinds that keep no point to start from, and commands that take a folder otherwise.
"$epicyclic" crosscheck --from run_one:0 "${methods[@]}" -o crosscheck >/dev/null 2>&1 || fail "the crosscheck"
"$epicyclic" tolerance --from run_one:0 "${methods[@]}" "${tolerances[@]}" -o tolerance >/dev/null 2>&1 || fail "the tolerance study"
"$epicyclic" continue "$inputs/tang2020_branches.json" --from run_one:0 "${near[@]/#/--set=/study/}" --set /study/from=2.7999 --set /study/to=2.8001 -o continue >/dev/null 2>&1 || fail "the branches"
"$epicyclic" gear "$inputs/lin_parker_1999_n3.json" -o gear >/dev/null 2>&1 || fail "the gear"
cat >claims.json <<END
{ "stage": "$inputs/tang2020.json", "study": { "kind": "claims", "transient_periods": 10, "recorded_periods": 8, "period_max": 2,
  "sweeps": [ { "name": "s", "parameter": "mesh_frequency_ratio", "from": 2.7, "to": 2.8, "points": 2, "screening_points": 2, "survey_points": 2 } ],
  "claims": [ { "name": "A", "text": "it moves", "conditions": [ { "kind": "value", "sweep": "s", "quantity": "delta_sp_range", "at_least": 1e-6 } ] } ],
  "parameters": [ { "name": "zeta", "from": 0.02, "to": 0.1, "targets": [ { "pointer": "/stage/lumped/sun_planet_mesh/damping_ratio" } ] } ],
  "survey": { "draws": 2, "screening": { "transient_periods": 10, "recorded_periods": 8 } } } }
END
kinds=(crosscheck tolerance continue gear)
! has_claims || kinds+=(reproduce robustness)
for command in "${kinds[@]:4}"; do "$epicyclic" $command claims.json -o $command >/dev/null 2>&1 || fail "$command"; done
for kind in "${kinds[@]}"; do
  for command in run crosscheck tolerance "continue $inputs/tang2020_branches.json"; do takes 2 "$epicyclic" $command --from $kind:0; done
  takes 2 "$epicyclic" sweep "$inputs/tang2020_speed.json" --grow $kind
  takes 2 "$epicyclic" continue "$inputs/tang2020_branches.json" --against $kind
done
for kind in "${kinds[@]}" run_one sweep_one map_one; do
  takes '0 2' "$epicyclic" plot $kind
  [ "$(code_of "$epicyclic" assert $kind points.json --record)" = 2 ] || fail "assert --record of $kind: $(<stderr)"
  [ ! -e points.json ] || fail "assert --record of $kind wrote a file"
done
grep -q 'none of [0-9]* special points has' <("$epicyclic" assert continue points.json --record 2>&1) || fail "it is not said that there is no special point"

# Whichever file of a donor the machine cannot open or read: that is no verdict on the donor. Sanitizers want to be loaded first.
for donor in run_one sweep_one; do
  ! grep -qaE '__(asan|tsan)_init' "$epicyclic" || break
  from=("$epicyclic" run --from "$work/$donor:0" "${brief[@]}")
  with_shim=(env "FAULT_UNDER=$work/$donor" "LD_PRELOAD=$3")
  takes 0 "${with_shim[@]}" "FAULT_COUNT=$work/counts" "${from[@]}"
  opens=$(sed -n 's/^open //p' counts)
  [ "$opens" -gt 4 ] || fail "$donor is read by $opens opens"
  for ((k = 1; k <= opens; ++k)); do
    takes 5 "${with_shim[@]}" "FAULT=open:$k:EMFILE" "${from[@]}"
    takes 5 "${with_shim[@]}" "FAULT=read:$k:EIO" "${from[@]}"
    [ ! -e taken ] || fail "$donor could not be read, and a folder was left"
  done
done

# A run.json that was changed. The command of a study refuses its folder then, or makes its files again.
cp sweep_one/run.json run.json
for change in 's/"identity": "[^"]*"/"identity": {}/' 's/"identity": "[^"]*"/"identity": 5/' 's/"identity": "[^"]*"/"identity": null/' \
  's/"state": "complete"/"state": {}/' 's/"files": {/"files": 7, "others": {/' 's/"bytes": /"bytes": -/' 's/"sha256": "/"sha256": "0/' '1s/{/[{/;$s/}/}]/' '1,$d'; do
  sed "$change" run.json >sweep_one/run.json
  for command in run crosscheck tolerance "continue $inputs/tang2020_branches.json"; do takes '2 7' "$epicyclic" $command --from sweep_one:0; done
  takes '2 7' "$epicyclic" sweep "$inputs/tang2020_speed.json" --grow sweep_one
  takes '2 7' "$epicyclic" continue "$inputs/tang2020_branches.json" --against sweep_one
  takes '2 7' "$epicyclic" plot sweep_one
  code=$(code_of "$epicyclic" assert sweep_one points.json)
  [ "$code" = 2 ] || [ "$code" = 7 ] || fail "$change: assert: $code $(<stderr)"
  code=$(code_of "$epicyclic" sweep sweep_one/input.resolved.json -o sweep_one)
  [ "$code" = 0 ] || [ "$code" = 3 ] || fail "$change: its own command: $code $(<stderr)"
done
finish
