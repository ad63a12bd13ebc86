#!/usr/bin/env bash
# faults.sh EPICYCLIC SOURCE_DIR SHIM
#
# System calls that fail, one in a run or all from one on: writes, reads, fsync, rename, open, close, mkdir and ftruncate on
# the files of a study, writes to stdout and stderr; by error numbers, interrupted (EINTR), done by half, or with the death of
# the program in place of the call (tests/faults/shim.cpp). Over a sweep, a map, gear, run, and a sweep on two ranks, TRIALS
# of them (48) in all, spread evenly over the calls, shifted by SEED. A run ends with 0 and all outputs, or with 5 and a
# word of why; interruptions and halves are no errors (but an ftruncate of HDF5's: lib/store/hdf5_file.cpp); and the same command
# without faults ends with the same bytes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
shim=$3
! grep -qaE '__(asan|tsan)_init' "$epicyclic" || skip "sanitizers want to be loaded first"

trials=${TRIALS:-48}
seed=${SEED:-$RANDOM}
RANDOM=$seed
echo "TRIALS=$trials SEED=$seed"

without_drawing

few=(--set /study/transient_periods=2 --set /study/recorded_periods=4 --set /study/classification_periods=0)
sweep=("$epicyclic" sweep "${speeds[@]}" --set /study/points=2 "${few[@]}" --threads 1)
map=("$epicyclic" map "$inputs/tang2020_map.json" --set /study/first/points=2 --set /study/second/points=2 "${few[@]}" --threads 1)
gear=("$epicyclic" gear "$inputs/tang2020.json")
run=("$epicyclic" run "$inputs/tang2020_run.json" --set /operation/mesh_frequency_ratio=2.8 --set /study/recorded_periods=16
  --set /study/transient_periods=2 --set /study/exponent_periods=12 --set /study/check_tolerance=1e-6 --set /study/spectrum_periods=16 --set /study/history_periods=2)
ranks=("${sweep[@]}")
mpi=(mpirun --oversubscribe --mca pml ob1)
[ "$(id -u)" != 0 ] || mpi+=(--allow-run-as-root)
# Of each 16 trials, how many are of a study.
kinds=(sweep:5 map:3 gear:3 run:3)
if "$epicyclic" --version | grep -q '^MPI ' && command -v mpirun >/dev/null; then kinds+=(ranks:2); fi

faults=(write:ENOSPC write:EIO write:EINTR write:short write:kill write+:ENOSPC read:EIO read:EINTR read:short fsync:EIO
  fsync:EINTR fsync:kill rename:EIO rename:ENOSPC rename:EINTR rename:kill open:EMFILE open:EACCES open:EINTR open+:EMFILE
  close:EIO close:EINTR mkdir:EIO mkdir:EINTR truncate:EIO data:ENOSPC data:EPIPE data:EINTR data:short
  words:ENOSPC words:EPIPE words:EINTR words:short every:EINTR every:short)

# Runs study $1 in folder $2 with fault $3, or with none, and sets code.
study() {
  local -n arguments=$1
  local with=(env "FAULT_UNDER=$work/$2" "FAULT=$3" "LD_PRELOAD=$shim") start=()
  if [ "$1" = ranks ]; then
    start=("${mpi[@]}" -n 2)
    with+=("FAULT_RANK=$rank")
  fi
  [ -n "$3$count" ] || with=()
  [ -z "$count" ] || with+=("FAULT_COUNT=$count")
  code=$(code_of "${start[@]}" "${with[@]}" "${arguments[@]}" -o "$work/$2")
}

trial() {
  local kind=$1 fault=$2
  what="$kind, $fault"
  [ "$kind" != ranks ] || what+=", rank $rank"
  rm -rf trial
  count='' study "$kind" trial "$fault"
  case $fault:$code in
    *:EINTR:0 | *:short:0) ;;
    *:EINTR:* | *:short:*) fail "$what: exit code $code: $(<stderr)" ;;
    words:*:0 | data:*:5 | *:0 | *:5) ;;
    *:kill:137) ;;
    *) fail "$what: exit code $code: $(<stderr)" ;;
  esac
  [ "$code" != 5 ] || grep -q 'cannot\|did not\|was removed' stderr || fail "$what: not a word of why: $(<stderr)"
  case $fault:$code in
    data:*:0) [[ $fault = *:EINTR || $fault = *:short ]] || fail "$what: lost data, but exit code 0" ;;
    words:*) [ "$code" = 0 ] || fail "$what: exit code $code for lost words" ;;
  esac
  codes[$code]=$((${codes[$code]:-0} + 1))
  before=$failed
  [ "$code" != 0 ] || same_folder "$kind.whole" trial
  count='' study "$kind" trial ''
  [ "$code" = 0 ] || fail "$what: the same command again: exit code $code: $(<stderr)"
  same_folder "$kind.whole" trial
  [ "$failed" = "$before" ] || echo "  that was $what"
  made=$((made + 1))
}

# How often call $1 was made, by the counts in file $2.
calls() { [ "$1" = every ] && echo 1 || sed -n "s/^${1%+} //p" "$2"; }

# How many trials of each fault make $1 together, of calls that were made as often as files $2... say: where few were made
# there are as many trials as calls, and more of the others.
enough() {
  local share=$1 each=0 sum=-1 before file fault number
  shift
  while [ "$sum" -lt "$share" ]; do
    each=$((each + 1)) before=$sum sum=0
    for file; do
      for fault in "${faults[@]}"; do
        number=$(calls "${fault%:*}" "$file")
        sum=$((sum + (number < each ? number : each)))
      done
    done
    [ "$sum" -gt "$before" ] || break
  done
  echo "$each"
}

declare -A codes=()
made=0
rank=0
for part in "${kinds[@]}"; do
  kind=${part%:*}
  what=$kind
  count='' study "$kind" "$kind.whole" ''
  [ "$code" = 0 ] || fail "$kind: exit code $code: $(<stderr)"
  share=$((trials * ${part#*:} / 16))
  of=(0)
  [ "$kind" != ranks ] || of=(0 1)
  for rank in "${of[@]}"; do
    rm -rf counted
    count=$work/counts.$rank study "$kind" counted ''
    same_folder "$kind.whole" counted
  done
  each=$(enough "$share" "${of[@]/#/$work/counts.}")
  for rank in "${of[@]}"; do
    for fault in "${faults[@]}"; do
      # Of few trials not each fault gets one.
      [ "$share" -ge ${#faults[@]} ] || [ $((RANDOM % ${#faults[@]})) -lt "$share" ] || continue
      call=${fault%:*}
      [ "$call" != every ] || { trial "$kind" "$fault" && continue; }
      number=$(calls "$call" "counts.$rank")
      stretches=$((number < each ? number : each))
      for ((k = 0; k < stretches; ++k)); do
        # One of each of these equal stretches.
        first=$((k * number / stretches))
        last=$(((k + 1) * number / stretches))
        plus=${call##*[a-z]}
        trial "$kind" "${call%+}:$((first + 1 + RANDOM % (last - first)))$plus:${fault#*:}"
      done
    done
  done
  echo "$kind: $made trials so far, exit codes: $(for c in "${!codes[@]}"; do echo -n "$c: ${codes[$c]}  "; done)"
done
[ "$trials" -lt 1000 ] || [ ${#kinds[@]} -lt 5 ] || [ "$made" -ge $((trials * 9 / 10)) ] || fail "only $made trials"
finish
