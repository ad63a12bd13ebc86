#!/usr/bin/env bash
# run.sh PROGRAM SOURCE: epicyclic run as a user meets it: what it leaves, the same bytes twice, stopped and resumed,
# refused input.
set -uo pipefail
program=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$source"
failures=0
expect() {
  if ! eval "$2"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}
short=(--set /study/recorded_periods=32 --set /study/exponent_periods=12 --set /study/spectrum_periods=32
  --set /study/history_periods=8 --set /operation/mesh_frequency_ratio=2.1)

"$program" run inputs/tang2020_run.json -o "$work/a" "${short[@]}" > "$work/a.out" 2> "$work/a.err"
expect "a run ends with 0" "[ $? = 0 ]"
for file in run.json input.json input.resolved.json points.csv poincare.csv results.h5 summary.md history.csv spectrum.csv \
  exponents.csv multipliers.csv figures/history.png figures/phase_portrait.png figures/poincare_section.png \
  figures/spectrum.png figures/exponents.png figures/multipliers.png figures/contact.png figures/mesh_force.png; do
  expect "$file is there" "[ -s '$work/a/$file' ]"
done
expect "the summary is printed" "grep -q '^## Regime' '$work/a.out'"
expect "the regime is period 2" "grep -q 'repeats after 2 mesh periods' '$work/a/summary.md'"
expect "points.csv says so" "awk -F, 'NR == 2 { exit !(\$5 == \"periodic\" && \$6 == 2) }' '$work/a/points.csv'"

"$program" run inputs/tang2020_run.json -o "$work/a" "${short[@]}" > /dev/null 2> "$work/again.err"
expect "a complete folder is left alone" "grep -q 'complete already' '$work/again.err'"
"$program" run inputs/tang2020_run.json -o "$work/a" > /dev/null 2>&1
expect "another study is refused with 3" "[ $? = 3 ]"

"$program" run inputs/tang2020_run.json -o "$work/b" "${short[@]}" > /dev/null 2>&1 &
for _ in $(seq 600); do [ -e "$work/b/run.json" ] && break || sleep 0.1; done
kill -TERM $!
wait $!
expect "a signal ends it with 75" "[ $? = 75 ]"
"$program" run inputs/tang2020_run.json -o "$work/b" "${short[@]}" --json > "$work/b.out" 2> /dev/null
expect "resumed it ends with 0" "[ $? = 0 ]"
expect "as JSON" "grep -q '\"regime\": \"periodic\"' '$work/b.out'"
for file in points.csv poincare.csv results.h5 summary.md history.csv multipliers.csv figures/spectrum.png; do
  expect "$file has the same bytes" "cmp -s '$work/a/$file' '$work/b/$file'"
done

"$program" run inputs/tang2020_speed.json -o "$work/c" > /dev/null 2> "$work/c.err"
expect "a sweep is refused with 2" "[ $? = 2 ] && grep -q 'kind sweep' '$work/c.err' && [ ! -e '$work/c' ]"
"$program" run inputs/tang2020.json -o "$work/c" > /dev/null 2> "$work/c.err"
expect "a stage is refused with 2" "[ $? = 2 ] && [ ! -e '$work/c' ]"
"$program" run inputs/tang2020_run.json -o "$work/c" --set /study/exponent_period=3 > /dev/null 2> "$work/c.err"
expect "a typo is named" "[ $? = 2 ] && grep -q \"did you mean 'exponent_periods'\" '$work/c.err'"

echo "$failures failures"
[ "$failures" = 0 ]
