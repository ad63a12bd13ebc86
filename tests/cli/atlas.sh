#!/usr/bin/env bash
# atlas.sh EPICYCLIC SOURCE_DIR SHIM
#
# Published results of validation/ that are quick: `reproduce` gives the recorded verdicts, draws what is published, and
# the data of closed forms are those of their scripts. Published numbers that do not fit are refused.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

has_claims || skip "the program was built without claims"
validation=$2/validation

for name in linparker1999_modes cooleyparker2012_modes kahraman1994_torsion; do
  [ "$(code_of "$epicyclic" reproduce "$validation/$name" -o "$name")" = 0 ] || fail "$name: $(<stderr)"
  ! grep -q 'another study' stderr || fail "$name: the recorded verdicts are of another study"
  [ -s "$name/scorecard.csv" ] || fail "$name has no scorecard"
done
grep -q '^N4 translational,holds,' linparker1999_modes/scorecard.csv || fail "a verdict: $(<linparker1999_modes/scorecard.csv)"
grep -q '^N5 rotational,fails,' cooleyparker2012_modes/scorecard.csv || fail "a miss: $(<cooleyparker2012_modes/scorecard.csv)"

for name in abramowitz1964_mathieu kahramansingh1990_clearance singh_load_sharing; do
  "$validation/$name/closed_form" >closed || fail "$name: the data are not those of the closed form: $(<closed)"
done

# One wrong digit fails the claim, and is told from the recorded verdicts.
wrong=/study/claims/0/conditions/0/frequencies_Hz/1
[ "$(code_of "$epicyclic" reproduce "$validation/linparker1999_modes" --set $wrong=1474.7 -o wrong)" = 0 ] || fail "a wrong digit: $(<stderr)"
grep -q '^N3 rotational,fails,' wrong/scorecard.csv || fail "a wrong frequency holds: $(<wrong/scorecard.csv)"

refused() { # KEY=VALUE... MESSAGE
  local sets=()
  for set in "${@:1:$#-1}"; do sets+=(--set "$set"); done
  [ "$(code_of "$epicyclic" check "$validation/linparker1999_modes/claims.json" --no-time "${sets[@]}")" = 2 ] ||
    fail "$* is taken"
  grep -q -- "${!#}" stderr || fail "$*: $(<stderr)"
}
refused /study/claims/0/conditions/0/stage=n9 '"n9", which is no stage'
refused /study/claims/0/conditions/0/quantity=delta_sp_rms 'quantity: is not read by'
refused /study/claims/0/conditions/0/tolerance_Hz='[1, 2]' 'must be one, or one for each of the 6'
refused /study/claims/0/conditions/0/tolerance_Hz='[0]' 'must be > 0'
refused /study/stages/0/name=n4 'names must differ'
refused /study/figures/0/panels/0/sweep=s 'is not read by a panel of a stage'
refused /study/stages='[]' 'is empty, and so is /stages'
