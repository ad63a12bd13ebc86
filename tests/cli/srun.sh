#!/usr/bin/env bash
# srun.sh EPICYCLIC SOURCE_DIR
#
# Sweeps on ranks that Slurm starts: the same bytes as with threads; a rank killed, then resumed with another number of
# ranks; cancelled, then resumed; a plain srun without MPI. Skipped (77) unless EPICYCLIC_SRUN says how to start ranks
# on this host ("srun --mpi=pmix --overcommit"): nobody's queue is filled unasked.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
[ -n "${EPICYCLIC_SRUN:-}" ] || skip "EPICYCLIC_SRUN is not set"
"$epicyclic" --version | grep -q '^MPI ' || skip "built without MPI"
read -ra launch <<<"$EPICYCLIC_SRUN"

carried=(sweep "$inputs/tang2020_speed.json" --set /study/points=8 --set /study/transient_periods=60
  --set /study/recorded_periods=8 --set /study/classification_periods=64)
[ "$(code_of "$epicyclic" "${carried[@]}" -o carried --threads 2)" = 0 ] || fail "threads: $(<stderr)"
for ranks in 1 2 3; do
  [ "$(code_of "${launch[@]}" -n $ranks "$epicyclic" "${carried[@]}" -o carried.$ranks --threads 1)" = 0 ] ||
    fail "$ranks ranks: $(<stderr)"
  same_results carried carried.$ranks
  grep -q "\"ranks\": $ranks," carried.$ranks/run.json || fail "$ranks ranks: run.json says otherwise"
  [ "$(grep -c ' points, 0 failed' stdout)" = 1 ] || fail "$ranks ranks: not one summary: $(<stdout)"
done

# Ranks are no children of srun's, but they work here.
ranks_here() {
  local rank
  for rank in $(pgrep -x epicyclic || true); do
    if [ "/proc/$rank/cwd" -ef "$work" ]; then echo "$rank"; fi
  done
}

for victim in 0 1; do
  rm -rf cut
  "${launch[@]}" --kill-on-bad-exit=1 -n 2 "$epicyclic" "${carried[@]}" -o cut --threads 1 >stdout 2>stderr &
  pid=$!
  sleep "0.$((RANDOM % 6 + 3))"
  mapfile -t ranks < <(ranks_here)
  [ ${#ranks[@]} -le "$victim" ] || kill -KILL "${ranks[$victim]}" 2>/dev/null || true
  wait $pid || true
  [ "$(code_of "${launch[@]}" -n 3 "$epicyclic" "${carried[@]}" -o cut --threads 1)" = 0 ] ||
    fail "resume after kill -9: $(<stderr)"
  same_results carried cut
done

rm -rf cut
"${launch[@]}" -n 2 "$epicyclic" "${carried[@]}" --set /study/transient_periods=100000 -o cut --threads 1 \
  --set /study/points=4 >stdout 2>stderr &
pid=$!
sleep 2
job=$(squeue --noheader --me --format %A --sort=-i | head -1)
start=$(date +%s%3N)
scancel "$job"
while [ -n "$(ranks_here)" ] && [ $(($(date +%s%3N) - start)) -lt 10000 ]; do sleep 0.01; done
echo "cancelled: ranks gone after $(($(date +%s%3N) - start)) ms"
code=0
wait $pid || code=$?
[ "$code" != 0 ] || fail "cancelled: exit code 0"
grep -qE '"state": *"(stopped|running)"' cut/run.json || fail "cancelled: $(<cut/run.json)"

# Without MPI each task is a program of its own: one computes, the others find the folder in use.
code=$(code_of srun --mpi=none --overcommit -n 2 "$epicyclic" "${carried[@]}" -o alone --threads 1)
[ "$code" = 4 ] || fail "two programs without MPI must give exit 4, not $code: $(<stderr)"
[ "$(grep -c 'in use' stderr)" = 1 ] || fail "two programs without MPI: in use must be said once: $(<stderr)"
same_results carried alone

finish
