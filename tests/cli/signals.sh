#!/usr/bin/env bash
# signals.sh EPICYCLIC SOURCE_DIR
#
# SIGINT and SIGTERM: the program ends with code 75, at any moment, in the midst of a long point too, no record of its journal
# is lost, and the same command ends with the same bytes. MOMENTS (5, with sanitizers 2) random ones, seeded by SEED, for each
# signal and method. It spends no more than 2 s of each core after the signal; with TIMED=yes on a quiet machine (20 moments)
# it ends within 2 s, the real gnuplot's pictures included.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

command -v perl >/dev/null || skip "there is no perl to read the journal with"
moments=${MOMENTS:-$(or_if_slow $([ "${TIMED:-no}" = yes ] && echo 20 || echo 5) 2)}
seed=${SEED:-$RANDOM}
RANDOM=$seed
echo "MOMENTS=$moments SEED=$seed"
longest_ms=1500 # from the first line to a signal, about that of a whole run
[ "${TIMED:-no}" = yes ] || { without_drawing 0.1 && longest_ms=700; }
bound_ms=2000 # the contract's
threads=2
hang_s=300 # what takes this long does not end

now_ms() { date +%s%3N; }

# Milliseconds of processor time of all children that have ended.
children_ms() {
  times >times
  perl -ne '$. == 2 && print int(1000 * eval { my $s = 0; $s += 60 * $1 + $2 while /(\d+)m([\d.]+)s/g; $s })' times
}

# And of a process so far.
process_ms() {
  perl -MPOSIX -ne 's/.*\) //; my @f = split; print int(1000 * ($f[11] + $f[12]) / POSIX::sysconf(POSIX::_SC_CLK_TCK))' "/proc/$1/stat" 2>/dev/null || echo 0
}

# Runs `epicyclic sweep` with what follows, waits for its first line of progress (before it has set up its handlers, a job in the
# background ignores SIGINT) and for $2 more, sends it the signal $1; sets code and took_ms.
interrupted() {
  local signal=$1 delay=$2 begun
  rm -f stderr
  "$epicyclic" sweep "${@:3}" -o "$folder" >stdout 2>stderr &
  local pid=$!
  until grep -qs '^sweep ' stderr; do
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.005
  done
  sleep "$delay"
  journal_records "$folder/journal.bin" >records
  local spent_ms guard
  begun=$(now_ms)
  kill -s "$signal" "$pid" 2>/dev/null || true
  spent_ms=$(process_ms "$pid")
  (sleep $hang_s && kill -KILL "$pid") >/dev/null 2>&1 &
  guard=$!
  children_ms >before
  code=0
  wait "$pid" || code=$?
  took_ms=$(($(now_ms) - begun))
  children_ms >after
  cpu_ms=$(($(<after) - $(<before) - spent_ms))
  pkill -P $guard 2>/dev/null || true
  kill $guard 2>/dev/null || true
  wait $guard 2>/dev/null || true
  journal_records "$folder/journal.bin" >records_now
  cmp -s -n "$(stat -c %s records)" records records_now || fail "SIG$signal: records are gone"
}

longest() {
  [ "$cpu_ms" -le $((threads * bound_ms)) ] || fail "$1: $cpu_ms ms of processor time after the signal"
  judge_time "$1" "$took_ms" $bound_ms
  if [ "$took_ms" -gt "$most" ]; then most=$took_ms; fi
  if [ "$cpu_ms" -gt "$most_cpu" ]; then most_cpu=$cpu_ms; fi
}

short=("${speeds[@]}" --set /study/points=8 --set /study/transient_periods=60 --set /study/recorded_periods=8
  --set "/study/classification_periods=$(or_if_slow 640 64)" --threads $threads)
# One mesh period of it takes minutes.
long=("${speeds[@]}" --set /study/points=2 --set /study/from=1e-5 --set /study/to=2e-5
  --set /integrator/relative_tolerance=1e-13 --set /integrator/max_steps_per_period=1000000000 --threads $threads)
for method in arkode-dopri5 lanes-dopri5; do
  [ "$(code_of "$epicyclic" sweep "${short[@]}" --set "/integrator/method=$method" -o "$method")" = 0 ] || fail "$method: $(<stderr)"
  for signal in INT TERM; do
    what="SIG$signal, $method"
    most=0
    most_cpu=0
    stopped=0
    code=0
    for k in $(seq "$moments"); do
      if [ "$code" = 0 ]; then folder=short$signal$method$k; fi
      await_quiet
      interrupted "$signal" "$(moment $longest_ms)" "${short[@]}" --set "/integrator/method=$method"
      case $code in
        0) ;;
        75) stopped=$((stopped + 1)) ;;
        *) fail "$what: exit code $code: $(<stderr)" ;;
      esac
      longest "$what"
    done
    [ "$(code_of "$epicyclic" sweep "${short[@]}" --set "/integrator/method=$method" -o "$folder")" = 0 ] || fail "resumed after $what: $(<stderr)"
    same_results "$method" "$folder"
    echo "$what: $most ms at most, $most_cpu ms of processor time, $stopped of $moments stopped"

    # ThreadSanitizer keeps a signal for a thread until it calls the C library, which lanes do not within a mesh period.
    if [ "$method" = lanes-dopri5 ] && grep -qa '__tsan_init' "$epicyclic"; then
      echo "$what in a long point: not with ThreadSanitizer"
      continue
    fi
    most=0
    most_cpu=0
    await_quiet
    folder=long$signal$method
    interrupted "$signal" 0.5 "${long[@]}" --set "/integrator/method=$method"
    [ "$code" = 75 ] || fail "$what in a long point: exit code $code: $(<stderr)"
    grep -q 're-run the same command to resume' stderr || fail "$what in a long point does not say that the same command goes on"
    longest "$what in a long point"
    echo "$what in a long point: $most ms, $most_cpu ms of processor time"
  done
done
[ "${TIMED:-no}" != yes ] || echo "${timed:-0} judged by their time"
finish
