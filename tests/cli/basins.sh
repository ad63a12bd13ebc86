#!/usr/bin/env bash
# basins.sh EPICYCLIC SOURCE_DIR
#
# `basins`: tables, figure, attractors counted, the same bytes at 1, 2 and 3 threads and after kills, bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

# At this speed every start that is near leads to one orbit of period 1.
small=(--set /operation/mesh_frequency_ratio=2.8 --set /study/first/points=3 --set /study/second/points=2
  --set /study/transient=fixed --set /study/transient_periods=100 --set /study/recorded_periods=32)
basins() { "$epicyclic" basins "$inputs/tang2020_basins.json" "${small[@]}" "$@"; }

result_files=(points.csv attractors.csv results.h5 input.json input.resolved.json figures/basins.dat)

for threads in 1 2 3; do
  [ "$(code_of basins -o "t$threads" --threads "$threads")" = 0 ] || fail "basins with $threads threads: $(<stderr)"
done
same_results t1 t2
same_results t1 t3
[ "$(wc -l <t1/points.csv)" = 7 ] || fail "points.csv must have a header and 3 x 2 rows"
head -1 t1/points.csv | grep -q '^point,direction,value,second_value,attractor,status,regime,' ||
  fail "columns of points.csv: $(head -1 t1/points.csv)"
[ "$(wc -l <t1/attractors.csv)" = 2 ] || fail "one attractor: $(cut -c1-200 t1/attractors.csv)"
grep -q '^1,periodic,1,6,1,' t1/attractors.csv || fail "all cells on an orbit of period 1: $(cut -c1-200 t1/attractors.csv)"
[ ! -e t1/poincare.csv ] || fail "basins have no poincare.csv"
for kind in png svg gp dat; do [ -s "t1/figures/basins.$kind" ] || fail "figures/basins.$kind is missing"; done

[ "$(code_of basins -o t1)" = 0 ] || fail "a complete folder must give exit 0"
[ "$(code_of "$epicyclic" basins t1/input.resolved.json -o resolved --json)" = 0 ] || fail "resolved input: $(<stderr)"
grep -q '"cells": 6' stdout || fail "the summary as JSON: $(<stdout)"
cmp -s t1/points.csv resolved/points.csv || fail "the resolved input gives other cells"

# The base moves the starts: other transients, the same attractor.
[ "$(code_of basins -o base --set '/study/other_components={"y_s": 0.5, "w_p1_rate": -0.25}')" = 0 ] || fail "a base: $(<stderr)"
grep -q '^1,periodic,1,6,1,' base/attractors.csv || fail "with a base: $(cut -c1-200 base/attractors.csv)"
cmp -s t1/points.csv base/points.csv && fail "the base must move the starts"

# Killed again and again: the same bytes.
killed_until_done cut 100 "$epicyclic" basins "$inputs/tang2020_basins.json" "${small[@]}" -o cut --threads 2
same_results t1 cut

refused() {
  [ "$(code_of basins "$@" -o refused)" = 2 ] || fail "must be refused: $*"
  [ ! -e refused ] || fail "refused, but written to: $*"
}
refused --set /study/first/component=x_q
grep -q "did you mean 'x_s'" stderr || fail "the message must name what was meant: $(<stderr)"
refused --set /study/second/component=x_s
refused --set '/study/other_components={"x_ss": 1}'
refused --set '/study/other_components={"x_s": 1}'
refused --set '/study/other_components={"y_s": "much"}'
refused --set /study/first/parameter=x_s
[ "$(code_of "$epicyclic" sweep "$inputs/tang2020_basins.json" -o refused)" = 2 ] || fail "basins are no sweep"

finish
