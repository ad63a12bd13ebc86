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
launch=("${of_mpi[@]}" "${launch[@]}")

carried=(sweep "${speeds[@]}" --set /study/points=8 --set /study/transient_periods=60
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

# Starts two ranks on folder $1 and waits until both are there; `pid` is srun's. Jobs have a name of their own, so that
# nobody else's is cancelled.
job=epicyclic-$$
begin() {
  local folder=$1 waited
  shift
  "${launch[@]}" --job-name=$job --kill-on-bad-exit=1 -n 2 "$epicyclic" "$@" -o "$folder" --threads 1 \
    >stdout 2>stderr &
  pid=$!
  for ((waited = 0; waited < 1000; ++waited)); do
    mapfile -t ranks < <(ranks_here)
    [ ${#ranks[@]} -lt 2 ] || return 0
    sleep 0.01
  done
  fail "no two ranks within 10 s: $(<stderr)"
}

# Killed, or cancelled: whatever the number of ranks afterwards, the same bytes.
for end in "rank 0" "rank 1" job; do
  rm -rf cut
  begin cut "${carried[@]}"
  sleep "0.$((RANDOM % 5 + 3))"
  case $end in
    job) scancel --me --name=$job ;;
    *) kill -KILL "${ranks[${end#rank }]}" ;;
  esac
  code=0
  wait $pid || code=$?
  [ "$code" != 0 ] || fail "$end ended: exit code 0"
  [ "$(code_of "${launch[@]}" -n 3 "$epicyclic" "${carried[@]}" -o cut --threads 1)" = 0 ] ||
    fail "resume after the end of $end: $(<stderr)"
  same_results carried cut
done

# Cancelled: the ranks go; on a quiet machine (TIMED=yes) within the contract's 2 s.
await_quiet
begin long "${carried[@]}" --set /study/transient_periods=100000
sleep 1
start=$(date +%s%3N)
scancel --me --name=$job
while [ -n "$(ranks_here)" ] && [ $(($(date +%s%3N) - start)) -lt 300000 ]; do sleep 0.01; done
[ -z "$(ranks_here)" ] || fail "cancelled: a rank does not end"
gone=$(($(date +%s%3N) - start))
judge_time "cancelled: the end of the ranks" $gone 2000
echo "cancelled: ranks gone after $gone ms"
kill $pid 2>/dev/null || true  # inside an allocation nothing has that name
code=0
wait $pid || code=$?
[ "$code" != 0 ] || fail "cancelled: exit code 0"

# Without MPI each task is a program of its own: one computes, the others find the folder in use.
code=$(code_of "${launch[@]}" --mpi=none -n 2 "$epicyclic" "${carried[@]}" -o alone --threads 1)
[ "$code" = 4 ] || fail "two programs without MPI must give exit 4, not $code: $(<stderr)"
[ "$(grep -c 'in use' stderr)" = 1 ] || fail "two programs without MPI: in use must be said once: $(<stderr)"
same_results carried alone

finish
