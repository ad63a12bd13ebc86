#!/usr/bin/env bash
# old_names.sh EPICYCLIC SOURCE_DIR
#
# Old names of keys, values and columns: a warning names the new one; `keys` and `plot` take them; a folder whose input and
# tables have old names is complete, is drawn and gives points; both names at once are refused.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

few=(--set /study/from=2 --set /study/to=2.2 --set /study/points=3 --set /study/transient_periods=40 --set /study/recorded_periods=16
  --set /study/classification_periods=0 --set /integrator/relative_tolerance=1e-6 --set '/study/directions=["up"]')
swept() { code_of "$epicyclic" sweep "$inputs/tang2020_speed_fixed_ring.json" -o swept "${few[@]}" "$@"; }
[ "$(swept --set /study/start=carried)" = 0 ] || fail "an old value: $(<stderr)"
[ "$(grep -c "^warning: the value 'carried' of '/study/start' is now 'continued'; the old name works until 0.4.0$" stderr)" = 1 ] ||
  fail "the warning of an old value: $(<stderr)"
grep -q '"start": "continued"' swept/input.resolved.json || fail "the resolved input has the old value"
[ "$(swept)" = 0 ] || fail "the same study by its new names: $(<stderr)"
grep -q 'complete already' stderr || fail "the study by its new names is another one: $(<stderr)"
! grep -q 'old name' stderr || fail "a warning without an old name: $(<stderr)"

# As a program before the renaming left it: old names in the input and the table, whose digests run.json has.
sed -i '1s/tensile_force_/pull_/g; 1s/tensile_time_/pull_time_/g; 1s/converged/settled/' swept/points.csv
sed -i 's/"start": "continued"/"start": "carried"/; s/"plates"/"cheeks"/; s/"plate_thickness_mm"/"cheek_thickness_mm"/' swept/input.resolved.json
for file in points.csv input.resolved.json; do
  digest=$(sha256sum "swept/$file" | cut -d' ' -f1)
  awk -v file="\"$file\": {" -v digest="$digest" -v bytes="$(wc -c <"swept/$file")" '
    index($0, file) { inside = 1 }
    inside { sub(/"bytes": [0-9]+/, "\"bytes\": " bytes); sub(/"sha256": "[0-9a-f]+"/, "\"sha256\": \"" digest "\"") }
    /}/ { inside = 0 }
    { print }' swept/run.json >run.json
  mv run.json swept/run.json
done
cp -r swept before
[ "$(swept)" = 0 ] || fail "a folder with old names: $(<stderr)"
grep -q 'complete already' stderr || fail "a folder with old names is not complete: $(<stderr)"
[ "$(code_of "$epicyclic" plot swept -o figures --quantity pull_sp --quantity tensile_time_rp)" = 0 ] || fail "plot: $(<stderr)"
grep -q "^warning: the column 'pull_sp' is now 'tensile_force_sp'; the old name works until 0.4.0$" stderr || fail "the warning of a column: $(<stderr)"
[ "$(<stdout)" = "$(printf 'figure: figures/%s\n' tensile_force_sp.png tensile_force_sp.svg tensile_time_rp.png tensile_time_rp.svg)" ] ||
  fail "what is drawn: $(<stdout)"
[ "$(code_of "$epicyclic" run --from swept:1 -o run --set /study/exponent_periods=0 --set /study/spectrum_periods=8 --set /study/history_periods=8)" = 0 ] ||
  fail "run --from: $(<stderr)"
diff -r swept before >/dev/null || fail "the folder was changed"
# A part of it is done anew.
sed -i 's/"state": "complete"/"state": "stopped"/' swept/run.json
[ "$(swept)" = 0 ] || fail "resumed: $(<stderr)"
grep -q '"start": "continued"' swept/input.resolved.json || fail "resumed: the resolved input has the old value"
head -n 1 swept/points.csv | grep -q ',tensile_force_sp,' || fail "resumed: the table has old columns"

# Both, and the names of another kind of study.
[ "$(code_of "$epicyclic" check "$inputs/tang2020_branches.json" --set /study/max_step=0.05 --set /study/largest_step=0.04)" = 2 ] || fail "both names"
grep -q "/study/largest_step=0.04: /study/max_step: is given by its old name and" stderr || fail "both names: $(<stderr)"
[ "$(code_of "$epicyclic" check "$inputs/tang2020_speed.json" --set /study/largest_step=0.04)" = 2 ] || fail "a key of branches in a sweep"

# The list of keys.
[ "$("$epicyclic" keys pieces | tail -n 1)" = "'/study/pieces' is now '/study/shooting_intervals'; the old name works until 0.4.0" ] || fail "keys pieces"
"$epicyclic" keys settle_periods | grep -q "is now '/study/transient_periods'" || fail "keys settle_periods"
"$epicyclic" keys pull_sp | grep -q "the column 'pull_sp' is now 'tensile_force_sp'" || fail "keys pull_sp"
! "$epicyclic" keys period_max | grep -q 'old name' || fail "keys of a new name speak of an old one"
! "$epicyclic" schema | grep -qE '"(largest_step|pieces|settle_periods|cheeks|brief|carried|literal|straight)"' || fail "the schema has old names"
finish
