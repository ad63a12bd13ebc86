#!/usr/bin/env bash
# claims.sh EPICYCLIC SOURCE_DIR SHIM
#
# `reproduce`, `calibrate` and `robustness` of a small study of claims: scorecard, figures, what is recorded; the same
# bytes for any number of threads and ranks, and after a stop or kills in each phase; inputs that change or cannot be read; the
# result as an input; bad input. With WHOLE=yes the paper too.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

has_claims || skip "the program was built without claims"

cat >claims.json <<END
{ "name": "small", "operation": { "mesh_frequency_ratio": 2.5 }, "stage": "$inputs/tang2020.json",
  "stage_patch": { "load": { "power_kW": null, "torque_Nm": 400 },
    "lumped": { "sun_planet_mesh": { "error_amplitude_um": [2, 2.1, 2] } } },
  "integrator": { "method": "lanes-cash-karp", "relative_tolerance": 1e-6, "absolute_tolerance": 1e-8 },
  "study": { "kind": "claims", "starts": ["continued", "cold"],
    "transient_periods": 40, "recorded_periods": 16, "classification_periods": 32, "output_phases": 16,
    "sweeps": [
      { "name": "speed", "parameter": "mesh_frequency_ratio", "from": 1.5, "to": 2.5, "points": 5, "directions": ["up", "down"], "screening_points": 3 },
      { "name": "damping", "parameter": "damping_ratio", "from": 0.03, "to": 0.1, "points": 3, "screening_points": 2, "screening_round": 1,
        "at": [ { "parameter": "mesh_frequency_ratio", "value": 2.0 } ] },
      { "name": "alike", "parameter": "damping_ratio", "from": 0.03, "to": 0.1, "points": 3, "at": [ { "parameter": "mesh_frequency_ratio", "same_as": "/operation/mesh_frequency_ratio" } ] } ],
    "claims": [
      { "name": "A", "text": "little is chaotic", "where": "Fig. 1", "published": "0",
        "conditions": [ { "kind": "share", "sweep": "speed", "regime": "chaotic", "at_most": 0.45 } ] },
      { "name": "B", "text": "the range is small", "conditions": [
          { "kind": "value", "sweep": "damping", "quantity": "delta_sp_range", "at_most": 0.1 } ] } ],
    "figures": [ { "name": "fig1", "title": "Speed", "panels": [ { "sweep": "speed", "title": "(a)" }, { "sweep": "speed", "mesh": "ring_planet" } ] } ],
    "screening": { "transient_periods": 20, "recorded_periods": 8, "growth_periods": 8 },
    "parameters": [
      { "name": "E", "description": "error [um]", "from": 0.5, "to": 20, "targets": [
          { "pointer": "/stage/lumped/sun_planet_mesh/error_amplitude_um/0" },
          { "pointer": "/stage/lumped/sun_planet_mesh/error_amplitude_um/1", "times": "r" } ] },
      { "name": "r", "from": 0.9, "to": 1.1, "scale": "linear" },
      { "name": "T", "from": 150, "to": 900, "choice": "load", "option": "torque", "targets": [ { "pointer": "/stage/load/torque_Nm" } ] } ],
    "choices": [ { "name": "load", "options": [
        { "name": "torque", "sets": [ { "pointer": "/stage/load", "value": { "torque_Nm": 400 } } ] },
        { "name": "power", "sets": [ { "pointer": "/stage/load", "value": { "power_kW": 400 } } ] } ] } ],
    "search": { "seed": 3, "islands": 2, "population": 7, "candidates": 28, "refinement": 6, "profile": 2, "confirmed": 2 },
    "survey": { "draws": 6, "confirmed": 2, "screening": { "transient_periods": 20, "recorded_periods": 8, "growth_periods": 8 } } } }
END
[ "$(code_of "$epicyclic" check claims.json)" = 0 ] || fail "check: $(<stderr)"
! grep -q 'recurrence alone' stderr || fail "a warning without its reason: $(<stderr)"
slope='{ "pointer": "/model/gap_damping", "value": "contact_slope" }'
[ "$(code_of "$epicyclic" check claims.json --no-time --set "/study/choices/0/options/0/sets=[ $slope ]")" = 0 ] || fail "damping by contact as an option: $(<stderr)"
grep -q '/study/choices/0/options/0: .* recurrence alone' stderr || fail "it is not said that no candidate of an option can be told chaotic: $(<stderr)"
[ "$(code_of "$epicyclic" check claims.json --no-time --set "/study/choices/0/options/0/sets=[ $slope, { \"pointer\": \"/integrator/clearance_smoothing\", \"value\": 0.01 } ]")" = 0 ] || fail "the same with a smooth clearance: $(<stderr)"
! grep -q 'recurrence alone' stderr || fail "a warning without its reason, smooth: $(<stderr)"
[ "$(code_of "$epicyclic" check claims.json --no-time --set /model/gap_damping=contact_slope)" = 0 ] || fail "damping by contact: $(<stderr)"
grep -q '/model/gap_damping: .* recurrence alone' stderr || fail "it is not said of the stage as given: $(<stderr)"
width='[{ "pointer": "/integrator/clearance_smoothing", "factor": 0.001, "times": "r" }]'
[ "$(code_of "$epicyclic" check claims.json --no-time --set /model/gap_damping=contact_slope --set "/study/parameters/0/targets=$width")" = 0 ] || fail "a width by a parameter: $(<stderr)"
! grep -q 'recurrence alone' stderr || fail "a warning without its reason, smoothed by a parameter: $(<stderr)"
for odd in '{ "pointer": "/model", "value": 3 }, { "pointer": "/model/gap_damping", "value": "always" }' '{ "pointer": "/model", "value": [1] }'; do
  [ "$(code_of "$epicyclic" check claims.json --no-time --set "/study/choices/0/options/0/sets=[ $odd ]")" = 2 ] || fail "an option that makes no model: $(<stderr)"
done
# What changes nothing is told: a drawing's measure beside the numbers that would follow from it.
idle='[{ "pointer": "/stage/catalogue/carrier/body/plate_thickness_mm", "factor": 0.1 }]'
given=(--set "/study/parameters/2/targets=$idle" --set /stage/lumped/carrier/mass_kg=9 --set /stage/lumped/carrier/inertia_over_r2_kg=8)
[ "$(code_of "$epicyclic" check claims.json --no-time "${given[@]}")" = 0 ] || fail "a parameter without effect: $(<stderr)"
grep -q '/study/parameters/2: T changes nothing on any sweep' stderr || fail "it is not said that a parameter changes nothing: $(<stderr)"
[ "$(grep -c 'changes nothing' stderr)" = 1 ] || fail "others change something: $(<stderr)"
"$epicyclic" check claims.json --no-time --json >stdout 2>stderr
grep -q '2 claims on 3 sweeps' stderr || fail "check says nothing of claims: $(<stderr)"
cp stdout resolved.json
[ "$(code_of "$epicyclic" check resolved.json --no-time --json)" = 0 ] || fail "the resolved input: $(<stderr)"
cmp -s stdout resolved.json || fail "the resolved input does not resolve to itself"
# Whole sweeps would tell no chaos; what multiplies has to count where it does.
[ "$(code_of "$epicyclic" check claims.json --set /study/classification_periods=0)" = 2 ] || fail "chaos that nobody tells: $(<stderr)"
grep -q '/study/claims/0/conditions/0/regime.*needs classification_periods > 0' stderr || fail "it is not said: $(<stderr)"
[ "$(code_of "$epicyclic" check claims.json --set '/study/parameters/0/targets/1/times="T"')" = 2 ] || fail "multiplied by what counts in one reading alone: $(<stderr)"

# Scorecard and figures; each sweep is a study of its own.
[ "$(code_of "$epicyclic" reproduce claims.json -o one --threads 1)" = 0 ] || fail "reproduce: $(<stderr)"
grep -q '^| A | Fig. 1 | little is chaotic | 0 | holds | holds |' stdout || fail "no verdict: $(<stdout)"
grep -q '^1 of 2 claims hold' stdout || fail "no count: $(<stdout)"
grep -qx '6 sweeps together: [0-9].* in this session' stderr || fail "no time of all sweeps: $(<stderr)"
! grep -rq 'sweeps together' one || fail "a time in a result"
for file in scorecard.csv scorecard.md sweeps/speed/points.csv sweeps/damping_cold/run.json gear/gear.md; do
  [ -s "one/$file" ] || fail "no $file"
done
is_drawn one/figures/fig1
grep -q '"mesh_frequency_ratio": 2.0' one/sweeps/damping.json || fail "the sweep's speed is not in its input"
[ "$(code_of "$epicyclic" sweep one/sweeps/damping.json -o alone)" = 0 ] || fail "a sweep of it alone: $(<stderr)"
cmp -s alone/points.csv one/sweeps/damping/points.csv || fail "the sweep alone gives other points"
grep -q '"mesh_frequency_ratio": 2.5' one/sweeps/alike.json || fail "the sweep is not at the speed that it is to be like"
[ "$(code_of "$epicyclic" reproduce claims.json -o two --threads 2)" = 0 ] || fail "two threads: $(<stderr)"
for file in scorecard.csv sweeps/speed/points.csv figures/fig1.dat; do cmp -s "one/$file" "two/$file" || fail "$file differs with two threads"; done

# Of a sweep down alone that is judged and drawn, continued and from cold starts.
down=(--set '/study/sweeps/0/directions=["down"]' --set '/study/starts=["cold","continued"]')
[ "$(code_of "$epicyclic" reproduce claims.json -o down "${down[@]}")" = 0 ] || fail "a sweep down: $(<stderr)"
is_drawn down/figures/fig1

# What was recorded is expected.
[ "$(code_of "$epicyclic" reproduce claims.json -o one --record)" = 0 ] || fail "record: $(<stderr)"
[ "$(code_of "$epicyclic" reproduce claims.json -o one)" = 0 ] || fail "as recorded: $(<stderr)"
[ "$(code_of "$epicyclic" reproduce claims.json -o tight --set /integrator/relative_tolerance=1e-7)" = 0 ] || fail "at another tolerance: $(<stderr)"
! grep -q 'not compared' stderr || fail "another tolerance is no other study: $(<stderr)"
# A claim's words are no part of what is claimed.
[ "$(code_of "$epicyclic" reproduce claims.json -o said --set '/study/claims/0/text="little of it is chaotic"' --json)" = 0 ] || fail "other words: $(<stderr)"
! grep -q 'not compared' stderr || fail "other words are no other study: $(<stderr)"
! grep -q '"another_study"' stdout || fail "other words are told as another study: $(<stdout)"
[ "$(code_of "$epicyclic" reproduce claims.json -o bounds --set /study/claims/0/conditions/0/at_most=0.4 --json)" = 0 ] || fail "another bound: $(<stderr)"
grep -q '"another_study"' stdout && grep -q 'at_most: 0.45.* there, 0.4.* here' stdout || fail "nothing was compared, which --json does not say: $(<stdout)"
# Verdicts that contradict each other, and of claims that nobody makes, are not as recorded.
cp claims.scorecard.json sound.json
sed -i 's/"verdicts": \[/&\n{"claim":"A","continued":"fails"}, {"claim":"Z","continued":"holds"},/' claims.scorecard.json
[ "$(code_of "$epicyclic" reproduce claims.json -o one)" = 1 ] || fail "contradicting verdicts: $(<stderr)"
grep -q 'A (continued): holds, was recorded: fails and holds' stderr || fail "a claim that is recorded twice: $(<stderr)"
grep -q 'Z (continued): nothing, was recorded: holds' stderr || fail "a claim that nobody makes: $(<stderr)"
mv sound.json claims.scorecard.json
sed -i 's/"continued":"holds"/"continued":"fails"/' claims.scorecard.json
[ "$(code_of "$epicyclic" reproduce claims.json -o one)" = 1 ] || fail "a verdict that is not the one recorded: $(<stderr)"
grep -q 'A (continued): holds, was recorded: fails' stderr || fail "it is not said: $(<stderr)"
[ "$(code_of "$epicyclic" reproduce claims.json -o other --set /stage/load/torque_Nm=390 --set '/study/starts=["cold"]')" = 0 ] || fail "another load: $(<stderr)"
grep -q 'of another study and are not compared: /st' stderr || fail "it is not said that it is another study: $(<stderr)"
# Another stage has verdicts of its own, in a file that is named, and has to be there.
other=(reproduce claims.json -o other --set /stage/load/torque_Nm=390 --set '/study/starts=["cold"]' --expected other.verdicts.json)
[ "$(code_of "$epicyclic" "${other[@]}")" = 2 ] || fail "verdicts that are not there: $(<stderr)"
[ "$(code_of "$epicyclic" "${other[@]}" --record)" = 0 ] || fail "recording verdicts of another stage: $(<stderr)"
[ "$(code_of "$epicyclic" "${other[@]}")" = 0 ] || fail "another stage as recorded: $(<stderr)"
! grep -q 'not compared' stderr || fail "the verdicts of the other stage are not compared: $(<stderr)"
sed -i 's/"cold":"holds"/"cold":"fails"/' other.verdicts.json
[ "$(code_of "$epicyclic" "${other[@]}")" = 1 ] || fail "another verdict of the other stage: $(<stderr)"
cp other.verdicts.json kept.json
[ "$(code_of "$epicyclic" reproduce claims.json -o one --expected other.verdicts.json)" = 3 ] || fail "verdicts that are named and are of another study: $(<stderr)"
grep -q 'of another study and are not compared' stderr || fail "it is not said that the named verdicts are of another study: $(<stderr)"
cp claims.json kept_claims.json
[ "$(code_of "$epicyclic" reproduce claims.json -o one --expected claims.json --record)" = 2 ] || fail "a file that holds no verdicts must not be written over: $(<stderr)"
cmp -s claims.json kept_claims.json || fail "the input was written over"
cmp -s other.verdicts.json kept.json || fail "verdicts were written without --record"
grep -q '"continued":"fails"' claims.scorecard.json || fail "the verdicts beside the input were touched"
echo '{ "format": "none" }' >claims.scorecard.json
[ "$(code_of "$epicyclic" reproduce claims.json -o one)" = 2 ] || fail "no recorded verdicts: $(<stderr)"
rm claims.scorecard.json

# The search: the same bytes after a stop, and for any number of threads (below: where inputs are read once).
files=(candidates.csv profile.csv calibrate.md best.json stage.json)
[ "$(code_of "$epicyclic" calibrate claims.json -o c1 --threads 1)" = 0 ] || fail "calibrate: $(<stderr)"
"$epicyclic" calibrate claims.json -o c2 --threads 2 >stdout 2>stderr &
for ((k = 0; k < 400; ++k)); do
  [ "$(stat -c %s c2/journal.bin 2>/dev/null || echo 0)" -gt 2000 ] && break
  sleep 0.01
done
kill -INT $! 2>/dev/null || true
code=0 && wait $! || code=$?
[ $code = 75 ] || [ $code = 0 ] || fail "a stop: $code $(<stderr)"
[ "$(code_of "$epicyclic" calibrate claims.json -o c2 --threads 1)" = 0 ] || fail "going on: $(<stderr)"
[ "$(grep -om1 '"candidates": [0-9]*' c1/run.json)" = "$(grep -om1 '"candidates": [0-9]*' c2/run.json)" ] || fail "a stopped search counts other candidates: $(grep candidates c1/run.json) $(grep candidates c2/run.json) $(wc -l <c2/candidates.csv)"
for file in "${files[@]}"; do cmp -s "c1/$file" "c2/$file" || fail "$file differs after a stop"; done
# A search goes on from any number of its records, in each of its phases, by either method; and however often it is killed.
in_phase() { grep -c "^$1" "$2/candidates.csv"; }
for method in differential_evolution covariance_adaptation; do
  by=(calibrate claims.json --threads 1)
  [ $method = differential_evolution ] || by+=(--set "/study/search/method=$method")
  whole=whole_$method
  [ $method != differential_evolution ] || cp -r c1 "$whole" # the default
  [ "$(code_of "$epicyclic" "${by[@]}" -o "$whole")" = 0 ] || fail "$method: $(<stderr)"
  [ $method != differential_evolution ] || grep -q 'complete already' stderr || fail "$method is another search than the first: $(<stderr)"
  mapfile -t ends < <(journal_records "$whole/journal.bin" | cut -d ' ' -f 1)
  islands=$(in_phase island "$whole")
  refined=$((islands + $(in_phase refinement "$whole")))
  confirmed=$((refined + $(in_phase 'whole sweeps' "$whole")))
  [ ${#ends[@]} = $((confirmed + $(in_phase profile "$whole"))) ] || fail "$method: ${#ends[@]} records of other phases"
  for records in 0 $((islands / 2)) $islands $((islands + 1)) $((refined - 1)) "$refined" $((refined + 1)) "$confirmed" $((confirmed + 3)) ${#ends[@]}; do
    rm -rf cut && mkdir cut
    cp "$whole"/{.lock,input.json,input.resolved.json,run.json} cut
    sed -i 's/"state": "complete"/"state": "running"/' cut/run.json
    [ "$records" = 0 ] || head -c "${ends[records - 1]}" "$whole/journal.bin" >cut/journal.bin
    [ "$(code_of "$epicyclic" "${by[@]}" -o cut)" = 0 ] || fail "$method after $records records: $(<stderr)"
    same_folder "$whole" cut
  done
  rm "$whole/profile.csv" && cp -r "$whole" cut_output
  [ "$(code_of "$epicyclic" "${by[@]}" -o cut_output)" = 0 ] || fail "$method, a missing table: $(<stderr)"
  cmp -s cut/profile.csv cut_output/profile.csv || fail "$method: a missing table is made otherwise"
  rm -r cut_output
  killed_until_done "killed_$method" 300 "$epicyclic" "${by[@]}" -o "killed_$method"
  same_folder cut "killed_$method"
done

# Inputs are read once, before anything is computed: what is written over them afterwards changes nothing. Nor does the number of
# threads. A descriptor that is missing is the machine's trouble, not the input's.
mkdir files
sed "s#$inputs/tang2020.json#stage.json#" claims.json >claims.kept
shimmed=() # sanitizers want to be loaded first
grep -qaE '__(asan|tsan)_init' "$epicyclic" || shimmed=(env "FAULT_UNDER=$work/files" "LD_PRELOAD=$3")
for command in calibrate robustness; do
  for folder in read_once read_over; do
    counted=() threads=1
    [ $folder = read_once ] || threads=3
    [ ${#shimmed[@]} = 0 ] || [ $folder = read_over ] || counted=("${shimmed[@]}" "FAULT_COUNT=$work/counts")
    cp claims.kept files/claims.json && cp "$inputs/tang2020.json" files/stage.json
    "${counted[@]}" "$epicyclic" $command "$work/files/claims.json" -o "$folder" --threads $threads >stdout 2>stderr &
    if [ $folder = read_over ]; then
      until [ -e read_over/journal.bin ] || ! kill -0 $! 2>/dev/null; do sleep 0.01; done
      echo '{}' >files/stage.json && echo '{}' >files/claims.json
    fi
    code=0 && wait $! || code=$?
    [ $code = 0 ] || fail "$command, $folder: $code $(<stderr)"
  done
  same_folder read_once read_over
  rm -r read_once read_over
  [ ${#shimmed[@]} != 0 ] || continue
  cp claims.kept files/claims.json && cp "$inputs/tang2020.json" files/stage.json
  grep -qx 'open 2' counts || fail "$command does not open each of its two files once: $(grep open counts)"
  for file in 1 2; do
    [ "$(code_of "${shimmed[@]}" "FAULT=open:$file:EMFILE" "$epicyclic" $command "$work/files/claims.json" -o none)" = 5 ] || fail "$command without a descriptor: $(<stderr)"
    grep -q 'json: cannot open the file: Too many open files' stderr || fail "$command without a descriptor: $(<stderr)"
    [ ! -e none ] || fail "$command without a descriptor left a folder"
  done
done
# Led by multipliers candidates that fail cost otherwise, but the first one is the same and meets the same.
led=(--set /study/sweeps/0/screening_points=2 --set '/study/claims/0/conditions=[{ "kind": "share", "sweep": "speed", "regime": "chaotic", "at_least": 0.9 }]' --set '/study/search={ "seed": 3, "islands": 2, "population": 7, "candidates": 14, "refinement": 0, "profile": 0 }')
[ "$(code_of "$epicyclic" calibrate claims.json -o words "${led[@]}")" = 0 ] || fail "led by words: $(<stderr)"
[ "$(code_of "$epicyclic" calibrate claims.json -o led1 "${led[@]}" --set /study/search/regime_cost=multipliers --threads 1)" = 0 ] || fail "led by multipliers: $(<stderr)"
[ "$(code_of "$epicyclic" calibrate claims.json -o led2 "${led[@]}" --set /study/search/regime_cost=multipliers --threads 2)" = 0 ] || fail "led by multipliers, two threads: $(<stderr)"
cmp -s led1/candidates.csv led2/candidates.csv || fail "led by multipliers: candidates differ with two threads"
first() { sed -n 2p "$1/candidates.csv" | cut -d, -f "$2"; }
[ "$(first words 3)" != "$(first led1 3)" ] || fail "multipliers lead to nothing: $(sed -n 2p words/candidates.csv)"
[ "$(first words 5-8)" = "$(first led1 5-8)" ] || fail "multipliers decide: $(sed -n 2p words/candidates.csv) $(sed -n 2p led1/candidates.csv)"
[ "$(code_of "$epicyclic" calibrate claims.json -o jumps "${led[@]}" --set /study/search/regime_cost=multipliers --set /model/gap_damping=contact_slope)" = 2 ] || fail "multipliers where forces jump: $(<stderr)"
grep -q 'no tangents' stderr || fail "it is not said that there are no tangents: $(<stderr)"
[ "$(code_of "$epicyclic" calibrate claims.json -o c1)" = 0 ] || fail "complete: $(<stderr)"
grep -q 'calibrated: by claims of small, seed 3' c1/stage.json || fail "no origin"
is_drawn c1/figures/determination
[ "$(code_of "$epicyclic" check c1/best.json)" = 0 ] || fail "the best as an input: $(<stderr)"
[ "$(code_of "$epicyclic" gear c1/stage.json -o g)" = 0 ] || fail "its stage as an input: $(<stderr)"
# What whole sweeps said of the best is what its claims are held to.
[ "$(code_of "$epicyclic" reproduce c1/best.json -o whole --set '/study/starts=["continued"]')" = 0 ] || fail "the best held against sweeps: $(<stderr)"
for claim in A B; do
  said=$(grep "^| $claim |" c1/calibrate.md | awk -F'|' '{ gsub(/ /, "", $5); print $5 }')
  [ "$said" = holds ] || said=fails
  grep -q "^$claim,$said," whole/scorecard.csv || fail "claim $claim $said by whole sweeps of the search, but not by reproduce: $(<whole/scorecard.csv)"
done
# The first candidate is the stage as it is given, planets with unequal errors too.
[ "$(sed -n 2p c1/candidates.csv | cut -d, -f6-8)" = 2,1.05,400 ] || fail "the first candidate: $(sed -n 2p c1/candidates.csv)"

# Where further numbers that a parameter gives are others in the stage, the first candidate is not the stage.
errors=/stage/lumped/sun_planet_mesh/error_amplitude_um
uneven=(--set "$errors=[2, 2.1, 3]" --set "/study/parameters=[{\"name\": \"E\", \"from\": 1, \"to\": 4, \"targets\": [{\"pointer\": \"$errors/0\"}, {\"pointer\": \"$errors/2\"}]}]"
  --set '/study/choices=null' --set '/study/search={ "method": "differential_evolution", "seed": 3, "islands": 1, "population": 7, "candidates": 7, "refinement": 0, "profile": 0 }')
[ "$(code_of "$epicyclic" calibrate claims.json -o uneven "${uneven[@]}")" = 0 ] || fail "uneven errors: $(<stderr)"
grep -q "the first one has $errors/2 = 2 in place of 3" stderr || fail "it is not said that the first candidate is another: $(<stderr)"

# A speed in rpm stays what it is: the best as an input runs at it, and its claims are those that whole sweeps told. An
# element of an array that is computed can be searched for, too.
for target in /stage/lumped/sun/inertia_over_r2_kg /stage/lumped/sun_planet_mesh/stiffness_cos_N_per_m/0; do
  [ "$target" != "${target%kg}" ] && range='"from": 0.5, "to": 5' || range='"from": 1e8, "to": 2e8'
  fast=(--set /operation/mesh_frequency_ratio=null --set /operation/sun_speed_rpm=12000 --set /study/choices=null
    --set "/study/parameters=[{\"name\": \"X\", $range, \"targets\": [{\"pointer\": \"$target\"}]}]" --set '/study/sweeps/1/at=null'
    --set '/study/claims/1/conditions/0={"kind": "value", "sweep": "damping", "quantity": "delta_sp_rms", "statistic": "mean", "at_most": 0.06}'
    --set '/study/search={ "seed": 3, "islands": 1, "population": 7, "candidates": 7, "refinement": 0, "profile": 0, "confirmed": 1 }')
  rm -rf rpm rpm_best rpm_gear
  [ "$(code_of "$epicyclic" calibrate claims.json -o rpm "${fast[@]}")" = 0 ] || fail "$target: $(<stderr)"
  [ "$(code_of "$epicyclic" gear rpm/best.json -o rpm_gear)" = 0 ] || fail "the best at a speed in rpm: $(<stderr)"
  awk -F, '$1 == "sun_speed" && $2 > 11999.999 && $2 < 12000.001 { found = 1 } END { exit !found }' rpm_gear/geometry.csv || fail "$target: the best runs at $(grep '^sun_speed' rpm_gear/geometry.csv)"
  [ "$(code_of "$epicyclic" reproduce rpm/best.json -o rpm_best --set '/study/starts=["continued"]')" = 0 ] || fail "the best at a speed in rpm: $(<stderr)"
  said=$(grep "^| B |" rpm/calibrate.md | awk -F'|' '{ gsub(/ /, "", $5); print $5 }')
  [ "$said" = holds ] || said=fails
  grep -q "^B,$said," rpm_best/scorecard.csv || fail "$target: B $said by whole sweeps of the search, but not by reproduce"
done

# Nor does what a sweep sets of the stage change it.
heavy='[{"parameter": "/stage/lumped/sun/inertia_over_r2_kg", "value": 4}]'
[ "$(code_of "$epicyclic" reproduce claims.json -o rpm_at --set /operation/mesh_frequency_ratio=null --set /operation/sun_speed_rpm=12000 --set "/study/sweeps/1/at=$heavy" --set /study/choices=null --set /study/parameters=null --set '/study/starts=["cold"]')" = 0 ] || fail "a speed in rpm along a sweep of another stage: $(<stderr)"
speeds=$(awk -F, 'NR == 1 { for (c = 1; c <= NF; ++c) if ($c == "sun_speed_rpm") at = c } NR > 1 { printf "%.6f\n", $at }' rpm_at/sweeps/damping_cold/points.csv | sort -u)
[ "$speeds" = 12000.000000 ] || fail "the sweep of a heavier sun runs at $speeds rpm"

# A resolved input is the same study; one with a ratio in place of the speed is another one.
[ "$(code_of "$epicyclic" reproduce rpm_at/input.resolved.json -o rpm_again)" = 0 ] || fail "a resolved speed in rpm: $(<stderr)"
cmp rpm_at/sweeps/damping_cold/points.csv rpm_again/sweeps/damping_cold/points.csv || fail "a resolved input has not kept its speed in rpm"
[ "$(code_of "$epicyclic" reproduce rpm_at/input.resolved.json -o rpm_at --set /operation/mesh_frequency_ratio=1)" = 3 ] || fail "the ratio went on where the speed in rpm was: $(<stderr)"
grep -q '/operation/sun_speed_rpm: 12000.* there, absent here' stderr || fail "it is not said what differs: $(<stderr)"

# So it is with the stages of options: one with a heavier sun is at the same speed, from the resolved input too.
suns='[{"name": "sun", "options": [ {"name": "light", "sets": [{"pointer": "/stage/lumped/sun/inertia_over_r2_kg", "value": 1}]}, {"name": "heavy", "sets": [{"pointer": "/stage/lumped/sun/inertia_over_r2_kg", "value": 4}]} ]}]'
error='[{"name": "E", "from": 0.5, "to": 20, "targets": [{"pointer": "/stage/lumped/sun_planet_mesh/error_amplitude_um/0"}]}]'
few=(--set '/study/search={ "seed": 3, "islands": 1, "population": 7, "candidates": 14, "refinement": 0, "profile": 0 }')
[ "$(code_of "$epicyclic" calibrate claims.json -o suns --set /study/sweeps/1/at=null --set /operation/mesh_frequency_ratio=null --set /operation/sun_speed_rpm=12000 --set "/study/choices=$suns" --set "/study/parameters=$error" "${few[@]}")" = 0 ] || fail "options of suns: $(<stderr)"
[ "$(cut -d, -f7 suns/candidates.csv | grep -c 'light\|heavy')" = 14 ] || fail "no sun in: $(sed -n 1,2p suns/candidates.csv)"
[ "$(code_of "$epicyclic" calibrate suns/input.resolved.json -o suns_again)" = 0 ] || fail "options of suns, resolved: $(<stderr)"
cmp suns/candidates.csv suns_again/candidates.csv || fail "of options the resolved input has not kept its speed in rpm"

# Of options that differ in numbers alone the stage has the one with its own; a parameter of another option says nothing.
torques='[{"name": "load", "options": [ {"name": "low", "sets": [{"pointer": "/stage/load", "value": {"torque_Nm": 150}}]}, {"name": "high", "sets": [{"pointer": "/stage/load", "value": {"torque_Nm": 400}}]} ]}]'
of_low='[{"name": "E", "from": 0.5, "to": 20, "targets": [{"pointer": "/stage/lumped/sun_planet_mesh/error_amplitude_um/0"}]}, {"name": "T", "from": 10, "to": 100, "choice": "load", "option": "low", "targets": [{"pointer": "/stage/load/torque_Nm"}]}]'
[ "$(code_of "$epicyclic" calibrate claims.json -o torques --set "/study/choices=$torques" --set "/study/parameters=$of_low" "${few[@]}")" = 0 ] || fail "options of numbers: $(<stderr)"
! grep -q 'as it is given is no candidate' stderr || fail "the first candidate is the stage: $(<stderr)"
[ "$(sed -n 2p torques/candidates.csv | cut -d, -f8)" = high ] || fail "the first candidate has another load: $(sed -n 1,2p torques/candidates.csv)"
[ "$(code_of "$epicyclic" calibrate claims.json -o torques2 --set /stage/load/torque_Nm=500 --set "/study/choices=$torques" --set "/study/parameters=$of_low" "${few[@]}")" = 0 ] || fail "options of other numbers: $(<stderr)"
grep -q 'the first one has .*T = 100 in place of 500' stderr || fail "it is not said what the first candidate has: $(<stderr)"

# The survey of draws.
[ "$(code_of "$epicyclic" robustness claims.json -o r1)" = 0 ] || fail "robustness: $(<stderr)"
grep -q '^robustness, whole sweeps 2/2 ' stderr || fail "whole sweeps have no progress of their own: $(<stderr)"
grep -q '^| A | little is chaotic |' stdout || fail "no table: $(<stdout)"
for file in draws.csv robustness.csv influence.csv options.csv robustness.md figures/robustness.dat; do
  [ -s "r1/$file" ] || fail "no $file"
done
[ "$(wc -l <r1/draws.csv)" = 9 ] || fail "not a row per draw and for each that was confirmed"
grep -q '^By load, ' r1/robustness.md || fail "no table by the options of the choice: $(<r1/robustness.md)"
[ "$(wc -l <r1/options.csv)" = 5 ] || fail "not a row per option and claim: $(<r1/options.csv)"
grep -q '^2 of the draws, compared with whole sweeps' r1/robustness.md || fail "it is not said how many were confirmed"
is_drawn r1/figures/robustness

# On several ranks: the same bytes, also after a rank was killed; one rank talks.
if "$epicyclic" --version | grep -q '^MPI ' && command -v mpirun >/dev/null; then
  launch=("${of_mpi[@]}" mpirun --oversubscribe)
  [ "$(id -u)" != 0 ] || launch+=(--allow-run-as-root)
  for ranks in 2 3; do
    [ "$(code_of "${launch[@]}" -n $ranks "$epicyclic" calibrate claims.json -o "m$ranks" --threads 1)" = 0 ] || fail "$ranks ranks: $(<stderr)"
    for file in "${files[@]}"; do cmp -s "c1/$file" "m$ranks/$file" || fail "$file differs with $ranks ranks"; done
    grep -q "\"ranks\": $ranks," "m$ranks/run.json" || fail "run.json says otherwise of $ranks ranks"
    [ "$(grep -c '^best: ' stdout)" = 1 ] || fail "not one rank talks: $(<stdout)"
  done
  [ "$(code_of "${launch[@]}" -n 2 "$epicyclic" robustness claims.json -o rm --threads 1)" = 0 ] || fail "robustness on ranks: $(<stderr)"
  cmp -s r1/draws.csv rm/draws.csv || fail "draws.csv differs with ranks"
  for victim in 0 1; do
    rm -rf cut
    kill_after=cut kill_a_rank_of "$victim" "$epicyclic" calibrate claims.json -o cut
    [ "$(code_of "$epicyclic" calibrate claims.json -o cut)" = 0 ] || fail "after kill -9 of rank $victim: $(<stderr)"
    cmp -s c1/candidates.csv cut/candidates.csv || fail "candidates.csv differs after kill -9 of rank $victim"
  done
  [ "$(code_of "${launch[@]}" -n 2 "$epicyclic" calibrate none.json -o none --threads 1)" = 2 ] || fail "no input on ranks: $(<stderr)"
  [ "$(code_of "${launch[@]}" -n 2 "$epicyclic" reproduce claims.json -o none --threads 1)" = 2 ] || fail "reproduce is not shared: $(<stderr)"
fi

# Bad input; nothing is written.
refused() {
  sed "$1" claims.json >bad.json
  [ "$(code_of "$epicyclic" "$3" bad.json -o bad)" = 2 ] || fail "$1: exit code, $(<stderr)"
  grep -q -- "$2" stderr || fail "$1: $(<stderr)"
  [ ! -e bad ] || fail "$1: wrote"
}
refused 's/"regime": "chaotic"/"regime": "chaos"/' 'bad.json:14: /study/claims/0/conditions/0/regime: is "chaos", must be "period N"' reproduce
refused 's/"sweep": "damping", "quantity"/"sweep": "dumping", "quantity"/' '/study/claims/1/conditions/0/sweep: is "dumping", which is no sweep' reproduce
refused 's/"at_most": 0.1/"at_most": 0.1, "regimes": ["chaotic"]/' 'is not read by a condition of kind "value"' reproduce
refused 's/"name": "speed", "parameter"/"name": "..\/speed", "parameter"/' 'a folder is called so' reproduce
refused 's/"name": "damping", "parameter"/"name": "speed_cold", "parameter"/; s/"sweep": "damping"/"sweep": "speed_cold"/' 'as its cold starts are called' reproduce
refused 's/"from": 0.5, "to": 20/"from": -1, "to": 20/' '/study/parameters/0/from: is -1, must be > 0 on a logarithmic scale' calibrate
refused 's/"from": 0.9, "to": 1.1/"from": 0.9, "to": 1.1, "targets": [ { "pointer": "\/stage\/lumped\/none" } ]/' '/study/parameters/1/targets/0/pointer: .*is no value of the resolved input' calibrate
refused 's/"choice": "load", "option": "torque"/"choice": "load", "option": "talk"/' 'is "talk", which is no option of that choice' calibrate
refused 's/"regime": "chaotic", "at_most"/"regime": "chaotic", "which": "last", "at_most"/' '/which: is not read by a condition of kind "share"' reproduce
refused 's/"kind": "share", "sweep": "speed", "regime": "chaotic", "at_most": 0.45/"kind": "count", "sweep": "speed", "regime": "chaotic", "at_most": 2/' 'is 2 of the 5 points that "speed" has there; by screening_points it has 3' calibrate
refused 's/"same_as": "\/operation\/mesh_frequency_ratio"/"same_as": "\/stage\/lumped\/sun_planet_mesh\/damping_ratio"/' '/study/sweeps/2/at/0/same_as: .*which the sweep varies' reproduce
refused 's/"at": \[ { "parameter": "mesh_frequency_ratio", "same_as"/"at": [ { "parameter": "\/operation\/mesh_frequency_ratio", "value": 2 }, { "parameter": "sun_planet_backlash", "same_as"/' '/study/sweeps/2/at/1/same_as: .*which /at/0 sets' reproduce
refused 's/"regime": "chaotic", "at_most"/"regime": "chaotic", "from": 1.9, "to": 1.95, "at_most"/' 'its grid of 5 (points) has 0' reproduce
refused 's/"value": { "power_kW": 400 }/"value": { "power_kW": -4 }/' '/study/choices/0: with "power": .*power_kW: is -4' calibrate
refused 's/"pointer": "\/stage\/load", "value": { "power_kW": 400 }/"pointer": "\/study\/points", "value": 3/' 'must begin with /stage, /model or /operation' calibrate
refused 's/"pointer": "\/stage\/load", "value": { "power_kW": 400 }/"pointer": "\/stage\/~2", "value": 3/' 'unknown key' calibrate
refused 's/"candidates": 28/"candidates": 13/' 'must be >= islands x population = 14' calibrate
refused 's/"value": 2.0 }/"value": 2.0, "same_as": "\/operation\/mesh_frequency_ratio" }/' '/study/sweeps/1/at/0: must have "value" or "same_as", and not both' reproduce
refused 's/"value": 2.0 }/"same_as": "\/stage\/name" }/' '/study/sweeps/1/at/0/same_as: is "/stage/name", which is no number of the resolved input' reproduce
refused 's/"value": 2.0 }/"same_as": "\/stage\/lumped\/sun\/mass_kg" }/' '/study/sweeps/1/at/0/same_as: is "/stage/lumped/sun/mass_kg", which is computed from other numbers' reproduce
refused 's/"value": 2.0 }/"same_as": "\/stage\/~2" }/' '/study/sweeps/1/at/0/same_as: is "/stage/~2", which is no number of the resolved input' reproduce
refused 's/"name": "E", "description"/"name": "cost", "description"/' 'as a column of their tables is' calibrate
refused 's/"parameter": "damping_ratio"/"parameter": "damping"/' '/study/sweeps/1/parameter: is "damping", must be one of' calibrate
[ "$(code_of "$epicyclic" sweep claims.json -o bad)" = 2 ] || fail "a sweep of claims: $(<stderr)"
grep -q 'run `epicyclic reproduce`' stderr || fail "which command it is of: $(<stderr)"
# A stage outside the ranges is said to be moved into them.
sed 's/"from": 0.5, "to": 20/"from": 3, "to": 20/; s/"islands": 2/"islands": 1/; s/"candidates": 28/"candidates": 7/; s/"refinement": 6, "profile": 2, "confirmed": 2/"refinement": 0, "profile": 0/' claims.json >moved.json
[ "$(code_of "$epicyclic" calibrate moved.json -o moved)" = 0 ] || fail "outside the ranges: $(<stderr)"
grep -q 'the first one has E = 3 in place of 2' stderr || fail "it is not said: $(<stderr)"
sed 's/"torque_Nm": 400 } } \]/"torque_Nm": 400 } }, { "pointer": "\/model\/gap_damping", "value": "contact_slope" }, { "pointer": "\/integrator\/clearance_smoothing", "value": 0.01 } ]/; s/"islands": 2/"islands": 1/; s/"candidates": 28/"candidates": 7/; s/"refinement": 6, "profile": 2, "confirmed": 2/"refinement": 0, "profile": 0/' claims.json >moved.json
[ "$(code_of "$epicyclic" calibrate moved.json -o neither)" = 0 ] || fail "a stage of no option: $(<stderr)"
grep -q 'the first one has load = "torque", of whose options it has none' stderr || fail "it is not said that no option is the stage's: $(<stderr)"
[ "$(code_of "$epicyclic" reproduce nobody2021 -o bad)" = 2 ] || fail "no such claims: $(<stderr)"

# The paper's own, as it was recorded: some minutes.
if [ "${WHOLE:-no}" = yes ]; then
  [ "$(PATH=$with_gnuplot code_of "$epicyclic" reproduce tang2020 -o paper)" = 0 ] || fail "the paper's claims: $(<stderr)"
  ! grep -q 'not compared' stderr || fail "the recorded verdicts are of another study: $(<stderr)"
  for stage in printed printed_fixed_ring; do
    EPICYCLIC=$epicyclic "$inputs/../validation/tang2020/check_verdicts" --stage $stage --dots "$stage" same >verdicts ||
      fail "$stage: $(<verdicts)"
  done
fi

finish
