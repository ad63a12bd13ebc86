#!/usr/bin/env bash
# ranks.sh EPICYCLIC SOURCE_DIR
#
# Sweeps on several ranks: the same bytes as with threads, at 1, 2 and 3 ranks, by one chain at a time and in lanes; a rank
# killed at any moment, then resumed with another number of ranks or with none; stopped by a signal; each refusal said
# once, by its exit code. Skipped (77) without MPI.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
"$epicyclic" --version | grep -q '^MPI ' || skip "built without MPI"
command -v mpirun >/dev/null || skip "no mpirun"

# More ranks than cores are enough for bytes; Open MPI wants to be asked for that, and for running as root.
launch=("${of_mpi[@]}" mpirun --oversubscribe)
[ "$(id -u)" != 0 ] || launch+=(--allow-run-as-root)

without_drawing
study=(sweep "${speeds[@]}" --set /study/points=8 --set /study/transient_periods=60
  --set /study/recorded_periods=8 --set /study/classification_periods=64 --set '/study/start="cold"')
carried=("${study[@]}" --set '/study/start="continued"')
lanes=("${study[@]}" --set '/integrator/method="lanes-dopri5"')

for kind in study carried lanes; do
  declare -n arguments=$kind
  [ "$(code_of "$epicyclic" "${arguments[@]}" -o "$kind" --threads 2)" = 0 ] || fail "$kind, threads: $(<stderr)"
  for ranks in 1 2 3; do
    folder=$kind.$ranks
    [ "$(code_of "${launch[@]}" -n $ranks "$epicyclic" "${arguments[@]}" -o "$folder" --threads 1)" = 0 ] ||
      fail "$kind, $ranks ranks: $(<stderr)"
    same_results $kind "$folder"
    grep -q "\"ranks\": $ranks," "$folder/run.json" || fail "$kind, $ranks ranks: run.json says otherwise"
    # One rank talks.
    [ "$(grep -c ' points, 0 failed' stdout)" = 1 ] || fail "$kind, $ranks ranks: not one summary: $(<stdout)"
    [ "$(grep -c '16/16' stderr)" = 1 ] || fail "$kind, $ranks ranks: not one last line of progress: $(<stderr)"
  done
done
# Each rank had its part of 16 chains: a record takes more than the header of a journal.
for rank in 1 2; do [ "$(wc -c <study.3/journal.rank-$rank.bin)" -gt 1000 ] || fail "rank $rank computed nothing"; done

# A rank is killed: whatever the number of ranks afterwards, the same bytes. The work of a killed rank is not lost.
for victim in 0 1; do
  for resume in 1 3 threads; do
    rm -rf cut
    PICTURE_TAKES=0.1 kill_a_rank_of "$victim" "$epicyclic" "${carried[@]}" -o cut
    again=("$epicyclic")
    [ "$resume" = threads ] || again=("${launch[@]}" -n "$resume" "$epicyclic")
    [ "$(code_of "${again[@]}" "${carried[@]}" -o cut)" = 0 ] || fail "resume after kill -9 with $resume: $(<stderr)"
    same_results carried cut
  done
done

# SIGTERM to mpirun: the ranks go, then mpirun. On a quiet machine (TIMED=yes) within the contract's 2 s, which is as long as
# mpirun gives them: on a busy one it may have ended them in the midst.
# A process that has ended may wait for somebody to ask how (Z).
under_way() { grep -qE '^[0-9]+ \([^)]*\) [^ZX]' "/proc/$1/stat" 2>/dev/null; }
long=("${carried[@]}" --set /study/transient_periods=100000)
# Begins that study on two ranks, `ranks`, children of `pid`, and returns when both compute.
begin_long_study() {
  rm -rf stopped
  "${launch[@]}" -n 2 "$epicyclic" "${long[@]}" -o stopped --threads 1 >stdout 2>stderr &
  pid=$!
  for ((k = 0; k < 300; ++k)); do
    [ ! -e stopped/journal.rank-1.bin ] || break
    sleep 0.1
  done
  sleep 0.5
  mapfile -t ranks < <(pgrep -P $pid -x epicyclic || true)
  [ ${#ranks[@]} = 2 ] || fail "not two ranks but ${#ranks[@]}: $(<stderr)"
}
for signal in TERM INT; do
  await_quiet
  begin_long_study
  start=$(date +%s%3N)
  kill -s $signal $pid
  for rank in "${ranks[@]}"; do
    while under_way "$rank" && [ $(($(date +%s%3N) - start)) -lt 300000 ]; do sleep 0.01; done
    ! under_way "$rank" || fail "SIG$signal: a rank does not end"
  done
  gone=$(($(date +%s%3N) - start))
  judge_time "SIG$signal: the end of the ranks" $gone 2000
  code=0
  wait $pid || code=$?
  took=$(($(date +%s%3N) - start))
  [ "$code" != 0 ] || fail "SIG$signal: exit code 0"
  judge_time "SIG$signal: the end of mpirun" $took 2500
  # mpirun's own exit code, when it is mpirun that was signalled, is 1; the study says what became of it.
  state=$(grep -o '"state": *"[a-z]*"' stopped/run.json | head -n 1)
  case $state in
    *stopped*) [ "$(grep -c '^stopped ' stderr)" -le 1 ] || fail "SIG$signal: said more than once that it is stopped: $(<stderr)" ;;
    *running*) [ "$was_quiet" = no ] || fail "SIG$signal: ranks had to be ended in the midst on a quiet machine" ;;
    *) fail "SIG$signal: the study is neither stopped nor running: $state" ;;
  esac
  [ "$was_quiet" = no ] || [ "$(grep -c '^stopped ' stderr)" = 1 ] || fail "SIG$signal: not said once that it is stopped: $(<stderr)"
  echo "SIG$signal: ranks gone after $gone ms, exit code $code after $took ms"
done
# To one rank: all stop, and say so once.
begin_long_study
kill -TERM "${ranks[1]}"
code=0
wait $pid || code=$?
[ "$code" = 75 ] || fail "a signal to one rank must give exit 75, not $code: $(<stderr)"
[ "$(grep -c '^stopped after' stderr)" = 1 ] || fail "stopped, but not said once: $(<stderr)"

# Refusals.
once() {
  local expected=$1 text=$2
  shift 2
  code=$(code_of "${launch[@]}" -n 3 "$epicyclic" "$@")
  [ "$code" = "$expected" ] || fail "must give exit $expected, not $code: $*: $(<stderr)"
  [ "$(grep -c -- "$text" stderr)" = 1 ] || fail "must be said once: $text: $(<stderr)"
}
once 3 'contains another study' "${study[@]}" -o study.2 --set /integrator/relative_tolerance=1e-7
mkdir foreign && echo mine >foreign/thesis.txt
once 3 'contains files that are not those of a study' "${study[@]}" -o foreign
once 0 'complete already' "${study[@]}" -o study.2
once 2 '/study/points' "${study[@]}" -o refused --set /study/points=none
[ ! -e refused ] || fail "refused, but written to"
once 2 'only sweep' gear "$inputs/tang2020.json" -o refused
mkdir busy
(
  flock 9
  once 4 'in use' "${study[@]}" -o busy
  exit "$failed"
) 9>busy/.lock || failed=$((failed + 1))
# A journal that another process has open, as a rank of an earlier run that is not dead yet.
rm -rf cut && cp -r carried.2 cut
sed -i 's/"state": *"complete"/"state": "running"/' cut/run.json
(
  flock 9
  once 4 'in use' "${carried[@]}" -o cut
  exit "$failed"
) 9<>cut/journal.rank-1.bin || failed=$((failed + 1))
# Two records of one point that differ.
[ "$(code_of "$epicyclic" "${carried[@]}" -o cut)" = 0 ] || fail "merged again: $(<stderr)"
printf '\xff\x00\xff' | dd of=cut/journal.rank-1.bin bs=1 seek=2000 conv=notrunc status=none
sed -i 's/"state": *"complete"/"state": "running"/' cut/run.json
once 7 'damaged data' "${carried[@]}" -o cut
# A full disk: a small file system, for which one has to be root. A limit on the size of files would stop MPI itself.
if [ "$(id -u)" = 0 ] && unshare -m true 2>/dev/null; then
  mkdir disk
  export -f code_of
  code=$(launch="${launch[*]}" again="$epicyclic ${study[*]}" unshare -m bash -c '
    mount -t tmpfs -o size=128k none disk
    code_of $launch -n 2 $again -o disk/full
    mount -o remount,size=64m disk
    code_of $launch -n 3 $again -o disk/full
    cp -r disk/full full')
  [ "$code" = $'5\n0' ] || fail "a full disk must give exit 5, then 0, not $code: $(<stderr)"
  same_results study full
fi

finish
