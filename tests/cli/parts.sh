#!/usr/bin/env bash
# parts.sh EPICYCLIC SOURCE_DIR
#
# Studies of each kind that has parts by 1, 2, 3 and 7 of them in an order that SEED gives, with kills and repetitions: the
# same bytes as one process. Parts killed within KILLS sessions in all (6). Two starts of one part at once, a part that is
# missing, the command while a part runs, folders put together, refusals.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

kills=${KILLS:-6}
seed=${SEED:-1}
RANDOM=$seed
echo "KILLS=$kills SEED=$seed"
without_drawing

few=(--set /study/transient_periods=20 --set /study/recorded_periods=8 --set /study/classification_periods=0)
sweep=(sweep "${speeds[@]}" "${few[@]}" --set /study/points=8 --set '/study/start="cold"')
continued=("${sweep[@]}" --set '/study/start="continued"' --set /study/segments=3)
lanes=("${sweep[@]}" --set '/integrator/method="lanes-dopri5"')
map=(map "$inputs/tang2020_map.json" "${few[@]}" --set /study/first/points=4 --set /study/second/points=3)
basins=(basins "$inputs/tang2020_basins.json" --set /study/first/points=4 --set /study/second/points=3
  --set /study/transient_periods=20 --set /study/recorded_periods=8)
kinds=(sweep continued lanes map basins)
if has_claims; then
  cat >claims.json <<END
{ "name": "small", "operation": { "mesh_frequency_ratio": 2.5 }, "stage": "$inputs/tang2020.json",
  "integrator": { "method": "lanes-cash-karp", "relative_tolerance": 1e-6, "absolute_tolerance": 1e-8 },
  "study": { "kind": "claims", "starts": ["continued", "cold"],
    "transient_periods": 20, "recorded_periods": 8, "classification_periods": 0, "output_phases": 8,
    "sweeps": [
      { "name": "speed", "parameter": "mesh_frequency_ratio", "from": 1.5, "to": 2.5, "points": 4,
        "directions": ["up", "down"], "screening_points": 3 },
      { "name": "damping", "parameter": "damping_ratio", "from": 0.03, "to": 0.1, "points": 3, "screening_points": 2 } ],
    "claims": [
      { "name": "A", "text": "the range is small", "conditions": [
          { "kind": "value", "sweep": "damping", "quantity": "delta_sp_range", "at_most": 0.1 } ] },
      { "name": "B", "text": "and over speed", "conditions": [
          { "kind": "value", "sweep": "speed", "quantity": "delta_sp_range", "at_most": 0.2 } ] } ],
    "figures": [ { "name": "fig1", "title": "Speed", "panels": [ { "sweep": "speed", "title": "(a)" } ] } ],
    "parameters": [
      { "name": "E", "description": "error [um]", "from": 0.5, "to": 20, "targets": [
          { "pointer": "/stage/lumped/sun_planet_mesh/error_amplitude_um" } ] } ],
    "survey": { "draws": 8, "confirmed": 3, "screening": { "transient_periods": 20, "recorded_periods": 8, "growth_periods": 8 } } } }
END
  robustness=(robustness claims.json)
  reproduce=(reproduce claims.json)
  kinds+=(robustness reproduce)
fi
result_files=(input.json input.resolved.json)

# The part, with an exit code of 0 and no results.
part() {
  [ "$(code_of "$epicyclic" "${study[@]}" -o "$1" --threads 1 --part "$2")" = 0 ] || fail "$1, part $2: $(<stderr)"
}

for kind in "${kinds[@]}"; do
  declare -n study=$kind
  [ "$(code_of "$epicyclic" "${study[@]}" -o $kind --threads 2)" = 0 ] || fail "$kind, one process: $(<stderr)"
done

killed=0
rounds=0
while [ $rounds -lt ${#kinds[@]} ] || [ "$killed" -lt "$kills" ]; do
  [ $rounds -lt 1000 ] || { fail "only $killed parts could be killed" && break; }
  kind=${kinds[rounds % ${#kinds[@]}]}
  declare -n study=$kind
  counts=(3 2 7 1)
  of=${counts[rounds % 4]}
  folder=$kind.$rounds
  rounds=$((rounds + 1))
  for number in $(seq 1 $of | while read -r k; do echo "$RANDOM $k"; done | sort -n | cut -d ' ' -f 2); do
    if [ "$killed" -lt "$kills" ]; then
      "$epicyclic" "${study[@]}" -o "$folder" --threads 1 --part "$number/$of" >stdout 2>stderr &
      pid=$!
      sleep "$(moment 150)"
      kill -KILL $pid 2>/dev/null || true
      code=0
      { wait $pid || code=$?; } 2>/dev/null
      case $code in
        137) killed=$((killed + 1)) ;;
        0) ;;
        *) fail "$folder, part $number/$of: exit code $code: $(<stderr)" ;;
      esac
    fi
    # One of four is not repeated.
    if [ $((RANDOM % 4)) != 0 ]; then
      part "$folder" "$number/$of"
      [ ! -e "$folder/points.csv" ] || fail "$folder: a part wrote results"
      if [ $((RANDOM % 4)) = 0 ]; then
        part "$folder" "$number/$of"
        grep -q "is complete$([ "$kind" = reproduce ] || echo ' already'): " stdout || fail "$folder: part $number/$of was computed twice: $(<stdout)"
      fi
    fi
  done
  [ "$(code_of "$epicyclic" "${study[@]}" -o "$folder" --threads 2)" = 0 ] || fail "$folder: $(<stderr)"
  same_folder $kind "$folder"
  rm -rf "$folder"
done
echo "$killed kills of parts in $rounds folders"

declare -n study=sweep
# A part that is missing, and parts of two numbers. Four of the 16 points are those of 1/4.
part absent 1/4
part absent 3/4
part absent 1/2 # knows their points
grep -q 'is complete already: 8 of 16 points' stdout || fail "the points of other parts were computed again: $(<stdout)"
[ "$(code_of "$epicyclic" "${study[@]}" -o absent)" = 0 ] || fail "absent: $(<stderr)"
grep -q '8 of 16 points were computed by parts' stderr || fail "it is not said how many parts have computed: $(<stderr)"
grep -q 'no journal of part 2/4, 4/4' stderr || fail "it is not said which part is missing: $(<stderr)"
same_folder sweep absent
part absent 2/4
grep -q 'complete already' stderr || fail "a part of a complete study must say so: $(<stderr)"

# Parts at once, each twice: the folder is new to all of them.
for kind in sweep robustness reproduce; do
  [[ " ${kinds[*]} " = *" $kind "* ]] || continue
  declare -n study=$kind
  folder=atonce.$kind
  for number in 1 1 2 2 3 3; do
    (
      code=0
      said=$folder.said.$BASHPID
      "$epicyclic" "${study[@]}" -o "$folder" --threads 1 --part $number/3 >/dev/null 2>$said || code=$?
      echo $code >>"$folder.codes"
      [ $code = 0 ] || grep -q "another process computes part $number/3" $said || cat $said >>"$folder.wrong"
    ) &
  done
  wait
  [ ! -s "$folder.wrong" ] || fail "$kind, parts at once: $(<"$folder.wrong")"
  ! grep -qvE '^(0|75)$' "$folder.codes" || fail "$kind, parts at once must give 0 or 75: $(<"$folder.codes")"
  [ "$(grep -c '^0$' "$folder.codes")" -ge 3 ] || fail "$kind, parts at once: not each was computed: $(<"$folder.codes")"
  [ "$(code_of "$epicyclic" "${study[@]}" -o "$folder")" = 0 ] || fail "$folder: $(<stderr)"
  ! grep -q 'no journal of part' stderr || fail "$kind: no part is missing: $(<stderr)"
  same_folder $kind "$folder"
done

# Parts of claims in folders of their own, copied into one; one of them is missing, which is said.
if has_claims; then
  for kind in robustness reproduce; do
    declare -n study=$kind
    for number in 1 3; do part copied.$number.$kind $number/3; done
    cp -r copied.1.$kind/. copied.3.$kind
    [ "$(code_of "$epicyclic" "${study[@]}" -o copied.3.$kind --threads 1)" = 0 ] || fail "copied parts: $(<stderr)"
    grep -q 'were computed by parts' stderr && grep -q 'no journal of part 2/3;' stderr || fail "copied parts: $(<stderr)"
    same_folder $kind copied.3.$kind
    part copied.3.$kind 2/3
    grep -q 'complete already' stderr || fail "a part of a complete study must say so: $(<stderr)"
  done
  [ "$(code_of "$epicyclic" merge copied.1.robustness copied.1.robustness -o mixed)" = 2 ] || fail "merge of claims: $(<stderr)"
  grep -q 'only folders of sweep, map and basins are merged' stderr || fail "merge of claims: $(<stderr)"
fi
declare -n study=sweep

# Parts in folders of their own, put together: all of them, and one too few.
for number in 1 2 3; do part own.$number $number/3; done
[ "$(code_of "$epicyclic" merge own.2 own.3 own.1 -o merged)" = 0 ] || fail "merge: $(<stderr)"
grep -q '16 of 16 points exist already' stderr || fail "merge computed: $(<stderr)"
same_folder sweep merged
[ "$(code_of "$epicyclic" merge own.3 own.1 -o fewer)" = 0 ] || fail "merge of two: $(<stderr)"
same_folder sweep fewer
[ "$(code_of "$epicyclic" merge own.1 map -o mixed)" = 3 ] || fail "merge of two studies must give 3: $(<stderr)"
[ "$(code_of "$epicyclic" merge own.1 nothing -o mixed)" = 2 ] || fail "merge of no study must give 2: $(<stderr)"
[ ! -e mixed ] || fail "refused, but merged"

# While a part runs: the same part, another one, and the command without --part.
long=("${study[@]}" --set /study/transient_periods=100000)
"$epicyclic" "${long[@]}" -o running --threads 1 --part 1/2 >/dev/null 2>running.err &
pid=$!
for ((k = 0; k < 300; ++k)); do
  [ ! -s running/journal.part-1-of-2.bin ] || break
  sleep 0.02
done
[ "$(code_of "$epicyclic" "${long[@]}" -o running --part 1/2)" = 75 ] || fail "the same part twice must give 75: $(<stderr)"
grep -q 'another process computes part 1/2' stderr || fail "the same part twice: $(<stderr)"
[ "$(code_of "$epicyclic" "${long[@]}" -o running)" = 4 ] || fail "while a part runs, the command must give 4: $(<stderr)"
grep -q 'parts of a study are computed in it' stderr || fail "while a part runs: $(<stderr)"
[ "$(code_of "$epicyclic" "${study[@]}" -o running --part 2/2)" = 3 ] || fail "another study must give 3: $(<stderr)"
kill -TERM $pid
code=0
wait $pid || code=$?
[ $code = 75 ] || fail "a stopped part must give 75, not $code"
grep -q 'part 1/2 stopped after' running.err || fail "a stopped part: $(<running.err)"

# Refusals.
refused() {
  local text=$1
  shift
  [ "$(code_of "$epicyclic" "$@" -o refused)" = 2 ] || fail "must give 2: $*: $(<stderr)"
  grep -q -- "$text" stderr || fail "must say $text: $*: $(<stderr)"
  [ ! -e refused ] || fail "refused, but written to: $*"
}
for text in 0/3 4/3 1/0 1 1/x 1/3/3 -1/3 1/10001; do refused 'is not K/N' "${study[@]}" --part=$text; done
refused 'only sweep, map, basins, robustness and reproduce' run "$inputs/tang2020_run.json" --part 1/2
refused 'excludes' "${study[@]}" --part 1/2 --report
if has_claims; then
  refused 'the islands exchange candidates' calibrate claims.json --part 1/2
  refused 'excludes' reproduce claims.json --part 1/2 --record
fi
finish
