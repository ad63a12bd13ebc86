#!/usr/bin/env bash
# without.sh EPICYCLIC SOURCE_DIR
#
# The program that is built beside it without MPI and without claims: it leaves the same bytes on one machine, and names
# what is missing with exit code 2, having written nothing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

full=$epicyclic
epicyclic=$(dirname "$full")/epicyclic_without
[ "$("$epicyclic" --version | grep -c '^MPI')" = 0 ] || fail "it was built with MPI"
short=(--set /study/points=4 --set /study/transient_periods=4 --set /study/recorded_periods=8)
for program in full epicyclic; do
  [ "$(code_of "${!program}" sweep "${speeds[@]}" "${short[@]}" -o "$program" --threads 2)" = 0 ] || fail "a sweep: $(<stderr)"
done
same_results full epicyclic

echo '{ "stage": "'"$inputs/tang2020.json"'", "study": { "kind": "claims", "sweeps": [], "claims": [] } }' >claims.json
for command in reproduce calibrate robustness check; do
  output=(-o out)
  [ $command != check ] || output=()
  [ "$(code_of "$epicyclic" $command claims.json "${output[@]}")" = 2 ] || fail "$command without claims: $(<stderr)"
  grep -q 'built without claims' stderr || fail "$command does not say what is missing: $(<stderr)"
  { [ ! -s stdout ] && [ ! -e out ]; } || fail "$command without claims leaves something"
  "$epicyclic" --help >help && grep -q "^  $command " help || fail "$command is not among the commands"
done
[ "$(grep -c claims stderr)" = 1 ] || fail "more is said of a kind that is missing than that: $(<stderr)"
[ "$("$epicyclic" keys | grep -c claim)" = 0 ] || fail "keys of claims are listed"

[ "$(OMPI_COMM_WORLD_SIZE=2 code_of "$epicyclic" sweep "${speeds[@]}" "${short[@]}" -o out)" = 2 ] || fail "two processes: $(<stderr)"
grep -q 'built without MPI' stderr || fail "it is not said that MPI is missing: $(<stderr)"
[ ! -e out ] || fail "two processes that cannot work together leave a folder"
finish
