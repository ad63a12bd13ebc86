#!/usr/bin/env bash
# trust.sh EPICYCLIC SOURCE_DIR
#
# `tolerance` and `crosscheck`: tables, figures, exit codes, the same bytes at 1 and 2 threads, complete folders, studies of
# another kind.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

cat >crosscheck.json <<END
{ "stage": "$inputs/tang2020.json",
  "integrator": { "relative_tolerance": 1e-8, "absolute_tolerance": 1e-10 },
  "study": { "kind": "crosscheck", "from": 2.6, "to": 2.8, "points": 2, "transient_periods": 20, "recorded_periods": 16,
             "methods": ["arkode-dopri5", "arkode-esdirk547b", "cvode-adams"], "clearance_smoothings": [0.1] } }
END
[ "$(code_of "$epicyclic" crosscheck crosscheck.json -o c1 --threads 1)" = 1 ] || fail "a width of 0.1 differs: exit 1: $(<stderr)"
# The resolved input by 2 threads.
"$epicyclic" check --no-time --json crosscheck.json >resolved.json 2>/dev/null
[ "$(code_of "$epicyclic" crosscheck resolved.json -o c2 --threads 2)" = 1 ] || fail "a resolved cross-check with 2 threads: $(<stderr)"
for file in crosscheck.csv crosscheck.md points.csv poincare.csv figures/crosscheck.dat; do
  cmp -s "c1/$file" "c2/$file" || fail "$file differs between 1 thread and the resolved input by 2"
done
is_drawn c1/figures/crosscheck
[ "$(wc -l <c1/crosscheck.csv)" = 7 ] || fail "crosscheck.csv must have a header and 2 x 3 rows"
[ "$(grep -c ',agree,' c1/crosscheck.csv)" = 4 ] || fail "the methods must agree: $(cat c1/crosscheck.csv)"
grep -q '^- mesh_frequency_ratio = 2.8, sun [0-9.]* rpm (up), .*: smoothing; ' c1/crosscheck.md || fail "a difference without its speed: $(<c1/crosscheck.md)"
[ "$(grep -c ',smoothing,' c1/crosscheck.csv)" = 2 ] || fail "the width must be what differs: $(cat c1/crosscheck.csv)"
[ "$(code_of "$epicyclic" crosscheck crosscheck.json -o c1)" = 1 ] || fail "a complete folder with differences must give exit 1 again"
[ "$(code_of "$epicyclic" crosscheck crosscheck.json -o c3 --set '/study/clearance_smoothings=[1e-6]' --set '/study/methods=["arkode-dopri5"]')" = 0 ] ||
  fail "a width of 1e-6 must agree: $(<stdout)"

# A sweep that checks itself: points of periods 1 and 2, the table beside the figure, the same bytes at 1 and 2 threads, and
# killed on the way; exit code 1, and again, where a difference stays unexplained.
checked=(sweep "$inputs/tang2020_speed.json" --set /study/from=2.1 --set /study/to=2.3 --set /study/points=9 --set '/study/directions=["up"]'
  --set /study/transient_periods=40 --set /study/recorded_periods=16 --set /study/crosscheck/points=4)
[ "$(code_of "$epicyclic" "${checked[@]}" -o s1 --threads 1)" = 0 ] || fail "a sweep with its cross-check: $(<stdout)$(<stderr)"
grep -q '^cross-check by other methods: [0-9]* of 8 comparisons differ, 0 unexplained' stdout || fail "no line of the cross-check: $(<stdout)"
grep -q '^reference: lanes-cash-karp' s1/crosscheck.md || fail "no table of the cross-check: $(<s1/crosscheck.md)"
[ "$(wc -l <s1/crosscheck.csv)" = 9 ] || fail "crosscheck.csv must have a header and 4 x 2 rows: $(<s1/crosscheck.csv)"
for method in arkode-dopri5 cvode-adams; do grep -q ",$method,.*,agree," s1/crosscheck.csv || fail "$method agrees nowhere: $(<s1/crosscheck.csv)"; done
PICTURE_TAKES=0.1 killed_until_done s2 700 "$epicyclic" "${checked[@]}" -o s2 --threads 2
same_folder s1 s2
rm s2/crosscheck.md
[ "$(code_of "$epicyclic" "${checked[@]}" -o s2)" = 0 ] || fail "the table made again: $(<stderr)"
same_folder s1 s2
# What is not explained is followed for 40000 periods: by fast methods, short periods, and roughly.
unexplained=(--set /study/crosscheck/orbit_tolerance=1e-14 --set /study/crosscheck/points=1 --set '/study/crosscheck/methods=["lanes-cash-karp"]'
  --set /integrator/method=lanes-dopri5 --set /integrator/relative_tolerance=1e-4 --set /integrator/absolute_tolerance=1e-6
  --set /study/from=3.3 --set /study/to=3.5 --set /study/points=3)
for time in first second; do
  [ "$(code_of "$epicyclic" "${checked[@]}" -o s3 "${unexplained[@]}")" = 1 ] || fail "unexplained, $time: $(<stdout)"
done
grep -q '"unexplained": [1-9]' s3/run.json || fail "run.json does not count what is unexplained"
[ "$(code_of "$epicyclic" sweep "$inputs/tang2020_speed.json" -o none --set /study/crosscheck/points=-1)" = 2 ] || fail "-1 points to check"
[ "$(code_of "$epicyclic" sweep "$inputs/tang2020_speed.json" -o none --set '/study/crosscheck/methods=[]')" = 2 ] || fail "no method to check by"

cat >tolerance.json <<END
{ "stage": "$inputs/tang2020.json",
  "study": { "kind": "tolerance", "from": 2.8, "to": 2.8, "points": 1, "transient_periods": 100, "recorded_periods": 16,
             "methods": ["arkode-dopri5", "cvode-adams"], "tolerances": [1e-5, 1e-6, 1e-7],
             "clearance_smoothings": [0.05, 0.02, 0.01], "chaotic_periods": 64 } }
END
[ "$(code_of "$epicyclic" tolerance tolerance.json -o t1 --threads 1)" = 0 ] || fail "tolerance: $(<stderr)"
grep -q "Recommendation" stdout || fail "no recommendation: $(<stdout)"
[ "$(code_of "$epicyclic" tolerance tolerance.json -o t2 --threads 2)" = 0 ] || fail "tolerance with 2 threads"
for file in tolerance.csv smoothing.csv quantities.csv statistics.csv tolerance.md points.csv; do
  cmp -s "t1/$file" "t2/$file" || fail "$file differs between 1 and 2 threads"
done
for figure in work_precision work_precision_time error_over_tolerance smoothing_bias; do
  is_drawn "t1/figures/$figure"
done
[ "$(wc -l <t1/tolerance.csv)" = 7 ] || fail "tolerance.csv must have a header and 2 x 3 rows"
[ "$(code_of "$epicyclic" tolerance tolerance.json -o t1)" = 0 ] || fail "a complete folder must give exit 0"

# Killed again and again: what was finished is kept, and the tables are the same.
PICTURE_TAKES=0.1 killed_until_done t3 300 "$epicyclic" tolerance tolerance.json -o t3 --threads 1
for file in tolerance.csv smoothing.csv quantities.csv statistics.csv tolerance.md points.csv; do
  cmp -s "t1/$file" "t3/$file" || fail "$file differs after kills"
done

# Kinds: a sweep serves both commands, another kind does not.
[ "$(code_of "$epicyclic" sweep tolerance.json -o x)" = 2 ] || fail "a tolerance study is no sweep"
[ ! -e x ] || fail "something was written for a wrong command"
[ "$(code_of "$epicyclic" crosscheck tolerance.json -o x)" = 2 ] || fail "a tolerance study is no cross-check"
[ "$(code_of "$epicyclic" tolerance "$inputs/lin_parker_1999_n3.json" -o x)" = 2 ] || fail "a stage has no points"
[ "$(code_of "$epicyclic" check --no-time tolerance.json)" = 0 ] || fail "check of a tolerance study: $(<stderr)"

# Bad input.
[ "$(code_of "$epicyclic" check --no-time tolerance.json --set '/study/methods=["dopri5"]')" = 2 ] || fail "an unknown method"
grep -q "arkode-dopri5" stderr || fail "the message must name the methods: $(<stderr)"
[ "$(code_of "$epicyclic" check --no-time tolerance.json --set /study/target_error=-1)" = 2 ] || fail "a negative target"
[ "$(code_of "$epicyclic" check --no-time crosscheck.json --set /study/target_error=1e-6)" = 2 ] || fail "a key of another kind"
[ "$(code_of "$epicyclic" sweep "$inputs/tang2020_speed.json" -o x --set /integrator/locate_contacts=true --set /integrator/method=cvode-bdf --set /study/points=2 --set /study/transient_periods=1 --set /study/recorded_periods=1)" = 2 ] ||
  fail "BDF cannot locate contacts: $(<stderr)"
[ ! -e x ] || fail "a study that cannot run has left a folder"

finish
