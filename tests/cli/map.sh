#!/usr/bin/env bash
# map.sh EPICYCLIC SOURCE_DIR
#
# `map`: tables, matrices, figures, the same bytes at 1, 2 and 3 threads, in lanes, after kills; complete folders, studies of
# another kind, bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

small=(--set /study/first/points=4 --set /study/second/points=3 --set /study/transient_periods=8
  --set /study/recorded_periods=8 --set /study/classification_periods=64 --set '/study/directions=["up","down"]')
map() { "$epicyclic" map "$inputs/tang2020_map.json" "${small[@]}" "$@"; }

result_files=(points.csv results.h5 input.json input.resolved.json figures/regimes_up.dat figures/lyapunov_max_down.dat)

# The input's own method, in lanes, and one that carries a trajectory at a time.
for method in lanes-dopri5 arkode-dopri5; do
  by=()
  [ "$method" = lanes-dopri5 ] || by=(--set "/integrator/method=$method")
  for threads in 1 2 3; do
    [ "$(code_of map -o "$method$threads" --threads "$threads" "${by[@]}")" = 0 ] ||
      fail "map with $threads threads by $method: $(<stderr)"
  done
  same_results "${method}1" "${method}2"
  same_results "${method}1" "${method}3"
done
whole=lanes-dopri51
[ "$(wc -l <$whole/points.csv)" = 25 ] || fail "points.csv must have a header and 2 x 4 x 3 rows"
head -1 $whole/points.csv | grep -q '^point,direction,value,second_value,status,regime,period,lyapunov_max,' ||
  fail "columns of points.csv: $(head -1 $whole/points.csv)"
[ ! -e $whole/poincare.csv ] || fail "a map has no poincare.csv"
for figure in regimes_up regimes_down lyapunov_max_up lyapunov_max_down; do
  for kind in png svg gp dat; do [ -s "$whole/figures/$figure.$kind" ] || fail "figures/$figure.$kind is missing"; done
done
# A cell takes little room: the whole journal, less than one Poincare section of 8 points for each cell.
[ "$(stat -c %s $whole/journal.bin)" -lt $((24 * 8 * 34 * 8)) ] || fail "the journal takes $(stat -c %s $whole/journal.bin) bytes"

# Complete; another study; the resolved input; --json.
[ "$(code_of map -o $whole)" = 0 ] || fail "a complete folder must give exit 0"
[ "$(code_of map -o $whole --set /integrator/relative_tolerance=1e-6)" = 3 ] || fail "another study must give exit 3"
[ "$(code_of "$epicyclic" map $whole/input.resolved.json -o resolved --json)" = 0 ] || fail "resolved input: $(<stderr)"
grep -q '"points": 24' stdout || fail "the summary as JSON: $(<stdout)"
cmp -s $whole/points.csv resolved/points.csv || fail "the resolved input gives other cells"

# Killed again and again: the same bytes.
killed_until_done cut 200 "$epicyclic" map "$inputs/tang2020_map.json" "${small[@]}" -o cut --threads 2
same_results $whole cut

# Two pointers, and failed cells.
[ "$(code_of map -o pointers --set /study/first/parameter=/stage/lumped/planet/bearing_N_per_m --set /study/first/from=5e7 \
  --set /study/first/to=5e8 --set /study/second/parameter=/stage/lumped/sun/support_N_per_m --set /study/second/from=1e8 \
  --set /study/second/to=2e8 --set /study/classification_periods=0)" = 0 ] || fail "two pointers: $(<stderr)"
for attempt in 1 2; do
  [ "$(code_of map --set /integrator/max_steps_per_period=3 -o few)" = 1 ] || fail "failed cells must give exit 1"
done

# Kinds and bad input: nothing is written.
refused() {
  [ "$(code_of map "$@" -o refused)" = 2 ] || fail "must be refused: $*"
  [ ! -e refused ] || fail "refused, but written to: $*"
}
[ "$(code_of "$epicyclic" sweep "$inputs/tang2020_map.json" -o refused)" = 2 ] || fail "a map is no sweep"
[ "$(code_of "$epicyclic" map "$inputs/tang2020_speed.json" -o refused)" = 2 ] || fail "a sweep is no map"
refused --set /study/second/parameter=mesh_frequency_ratio
refused --set /study/second/parameter=/operation/mesh_frequency_ratio
refused --set /study/second/parameter=/integrator/relative_tolerance
refused --set /study/second/from=-1
refused --set /study/first/from=5
refused --set /study/segments=2
refused --set /study/first/parameter=/stage/planets/count --set /study/first/from=2 --set /study/first/to=3

finish
