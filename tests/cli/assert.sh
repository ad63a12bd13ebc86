#!/usr/bin/env bash
# assert.sh EPICYCLIC SOURCE_DIR
#
# `assert`: special points recorded and held against a computation of their own, one by another tolerance, and others; exit
# codes, JUnit XML, bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

# The last flip of the speed diagram.
branches=(continue "$inputs/tang2020_branches.json" --set /study/from=2.14 --set /study/to=2.16 --set '/study/starts=[2.155]'
  --set /study/period_max=1)
[ "$(code_of "$epicyclic" "${branches[@]}" --set /study/tolerance=1e-9 -o fine)" = 0 ] || fail "continue: $(<stderr)"
[ "$(code_of "$epicyclic" assert fine points.json --record)" = 0 ] || fail "record: $(<stderr)"
[ "$(code_of "$epicyclic" assert fine points.json --record)" = 2 ] || fail "expected points must not be overwritten"
[ "$(code_of "$epicyclic" assert fine points.json --junit verdicts.xml)" = 0 ] || fail "against itself: $(<stdout)$(<stderr)"
grep -q '^agrees  *flip of period 1: expected 2.14894' stdout || fail "no table: $(<stdout)"
grep -q '^1 points expected, 1 found, 0 failed$' stdout || fail "no count: $(<stdout)"
grep -q '<testsuite name="fine" tests="1" failures="0"' verdicts.xml || fail "JUnit XML: $(<verdicts.xml)"
grep -q '<testcase classname="special_points" name="flip of period 1 at 2.14894' verdicts.xml || fail "JUnit XML: $(<verdicts.xml)"

# Computed too roughly to say anything: not the same study to its folder, but to its points.
[ "$(code_of "$epicyclic" "${branches[@]}" --set /study/tolerance=3e-7 -o rough)" = 0 ] || fail "continue: $(<stderr)"
[ "$(code_of "$epicyclic" assert rough points.json --junit verdicts.xml)" = 1 ] || fail "too uncertain: $(<stdout)$(<stderr)"
grep -q '^too uncertain' stdout || fail "no verdict: $(<stdout)"
grep -q '<failure type="too uncertain"' verdicts.xml || fail "JUnit XML: $(<verdicts.xml)"
# And what it says itself holds for the finer one.
[ "$(code_of "$epicyclic" assert rough rough.json --record)" = 0 ] || fail "record: $(<stderr)"
[ "$(code_of "$epicyclic" assert fine rough.json)" = 0 ] || fail "rough points do not hold for fine ones: $(<stdout)"

# The values are the file's; a point moved by more than its bound, one more, one less.
moved() { sed -E "$1" points.json >moved.json; }
moved 's/"value":2\.14894/"value":2.14895/'
[ "$(code_of "$epicyclic" assert fine moved.json)" = 1 ] || fail "moved: $(<stdout)"
grep -q '^differs' stdout || fail "no verdict: $(<stdout)"
moved 's/"kind":"flip"/"kind":"fold"/'
[ "$(code_of "$epicyclic" assert fine moved.json --json)" = 1 ] || fail "another kind: $(<stdout)"
[ "$(grep -c '"verdict": "missing"\|"verdict": "additional"' stdout)" = 2 ] || fail "verdicts: $(<stdout)"

# Another study, which says in what.
[ "$(code_of "$epicyclic" "${branches[@]}" --set /study/tolerance=1e-7 --set /stage/load/power_kW=390 -o other)" = 0 ] || fail "continue: $(<stderr)"
[ "$(code_of "$epicyclic" assert other points.json --json --junit verdicts.xml)" = 3 ] || fail "another load: $(<stdout)"
grep -q 'errors="1"' verdicts.xml && grep -q 'power_kW: 400.* there, 390.* here' verdicts.xml || fail "its XML: $(<verdicts.xml)"
grep -q '"another_study"' stdout && grep -q 'power_kW: 400.* there, 390.* here' stdout || fail "its JSON: $(<stdout)"
grep -q '/stage/load/power_kW: 400.* there, 390.* here' stderr || fail "in what: $(<stderr)"

moved 's/"base_pitch":"of_planet"/"base_pitch":"as_given"/'
[ "$(code_of "$epicyclic" assert fine moved.json)" = 3 ] || fail "another flag: $(<stdout)"
[ "$(grep -c ' there, .* here' stderr)" = 1 ] && grep -q 'base_pitch: "as_given" there' stderr || fail "more than the flag is listed: $(<stderr)"

# Bad input.
[ "$(code_of "$epicyclic" assert fine none.json)" = 2 ] || fail "no such file: $(<stderr)"
[ "$(code_of "$epicyclic" assert none points.json)" = 2 ] || fail "no such folder: $(<stderr)"
moved 's/"bound":[^,]*,/"bound":-1,"bounds":1,/'
[ "$(code_of "$epicyclic" assert fine moved.json --junit none.xml)" = 2 ] || fail "a bound below 0: $(<stdout)"
grep -q 'moved.json:4: /points/0/bound' stderr || fail "where: $(<stderr)"
grep -q 'bounds.*did you mean' stderr || fail "an unknown key: $(<stderr)"
# What an earlier run has left would pass for the verdicts of this one.
grep -q 'failures="0" errors="1"' none.xml && grep -q 'nothing could be compared.*/points/0/bound' none.xml || fail "its XML: $(<none.xml)"
mkdir $'od\xffd'
[ "$(code_of "$epicyclic" assert $'od\xffd' points.json --junit verdicts.xml)" = 2 ] || fail "an empty folder: $(<stderr)"
grep -q 'errors="1"' verdicts.xml && iconv -f UTF-8 -t UTF-8 verdicts.xml >/dev/null || fail "its XML: $(<verdicts.xml)"
# A link leads to what is written; what is no file stays what it is.
ln -s verdicts.xml link.xml
rm verdicts.xml
[ "$(code_of "$epicyclic" assert fine points.json --junit link.xml)" = 0 ] || fail "a link: $(<stderr)"
[ -L link.xml ] && grep -q '<testsuite' verdicts.xml || fail "the link was replaced"
ln -s new.json link.json
[ "$(code_of "$epicyclic" assert fine link.json --record)" = 0 ] || fail "a link to record: $(<stderr)"
[ -L link.json ] && cmp -s new.json points.json || fail "the link was replaced by what was recorded"
mkfifo pipe
for taken in pipe fine; do
  [ "$(code_of "$epicyclic" assert fine points.json --junit "$taken")" = 5 ] || fail "no file: $taken: $(<stderr)"
done
[ -p pipe ] || fail "the pipe was replaced"
echo '{ "format": "epicyclic expected points 1", "study": {}, "points": {} }' >moved.json
[ "$(code_of "$epicyclic" assert fine moved.json)" = 2 ] || fail "no points: $(<stdout)"
[ "$(grep -c 'moved.json:1:' stderr)" = 2 ] || fail "both mistakes: $(<stderr)"
echo '0,fold,2.15,1e-9,1,,,,1,1,,,,' >>fine/special.csv
[ "$(code_of "$epicyclic" assert fine points.json)" = 7 ] || fail "a changed table: $(<stderr)"

finish
