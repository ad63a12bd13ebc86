# Sourced by the scripts here: EPICYCLIC SOURCE_DIR are theirs. They work in a folder of their own, say what fails, go on,
# and end with `finish`.

epicyclic=$1
inputs=$2/inputs
# The paper's speeds by the reference method, without what the diagram is checked by.
speeds=("$inputs/tang2020_speed.json" --set /integrator/method=arkode-dopri5 --set /study/crosscheck/points=0)
failed=0
work=$(mktemp -d)
# A figure that was being drawn when its program was killed may still come: then once more. A signal between the fork and
# the start of a program finds this trap in the child, too.
remove_work() {
  [ "$BASHPID" = $$ ] || return 0
  rm -rf "$work" 2>/dev/null || { sleep 1; rm -rf "$work"; }
}
trap remove_work EXIT
cd "$work"

# $1, or $2 in a build with sanitizers, which is tens of times slower.
or_if_slow() {
  if grep -qaE '__(asan|tsan)_init' "$epicyclic"; then echo "$2"; else echo "$1"; fi
}

# Before what starts ranks: MPI libraries keep memory until a program ends, and AddressSanitizer is not to ask for it; and
# Open MPI takes two of its locks in one order and the other, all in one thread, for which ThreadSanitizer is not to end it.
echo 'deadlock:mca_btl_tcp' >"$work/.mpi.suppressions"
of_mpi=(env "ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
  "TSAN_OPTIONS=${TSAN_OPTIONS:+$TSAN_OPTIONS:}suppressions=$work/.mpi.suppressions")

fail() {
  echo "FAILED: $1"
  failed=$((failed + 1))
}

finish() {
  echo "$failed failures"
  [ "$failed" = 0 ]
}

# Whether the program was built with `reproduce`, `calibrate` and `robustness`.
has_claims() { [ "$("$epicyclic" schema | grep -c '"claims"')" != 0 ]; }

# ctest's SKIP_RETURN_CODE.
skip() {
  echo "skipped: $1"
  exit 77
}

# Exit code of a command, its output in stdout and stderr.
code_of() {
  local code=0
  "$@" >stdout 2>stderr </dev/null || code=$?
  echo "$code"
}

# What a study must have the same bytes in; scripts on other kinds than sweeps have a list of their own.
result_files=(points.csv poincare.csv results.h5 input.json input.resolved.json figures/bifurcation_delta_sp.dat)
same_results() {
  local file
  for file in "${result_files[@]}"; do
    cmp -s "$1/$file" "$2/$file" || fail "$file differs between $1 and $2"
  done
}

# How long something takes is decided by the machine's load as well, and no promise: it is judged only where TIMED=yes asks
# for it, and while nobody else wants the cores.
quiet() {
  local pids=() pid busy=0
  for ((k = 0; k < $(nproc); ++k)); do
    perl -MTime::HiRes=time -e '$begun = time; while ((times)[0] + (times)[1] < 0.2) {} exit(time - $begun > 0.25)' &
    pids+=($!)
  done
  for pid in "${pids[@]}"; do wait "$pid" || busy=1; done
  [ $busy = 0 ]
}

# Before what is judged by its time: waits for a quiet moment, for ten minutes in all of a script's life.
waits_left=120
await_quiet() {
  was_quiet=no
  [ "${TIMED:-no}" = yes ] || return 0
  until quiet; do
    [ $((waits_left--)) -gt 0 ] || { waits_left=0 && return 0; }
    sleep 5
  done
  was_quiet=yes
}

# After it: $1 took $2 ms and must not take more than $3.
judge_time() {
  [ "${TIMED:-no}" = yes ] || return 0
  if [ "$2" -le "$3" ]; then
    timed=$((${timed:-0} + 1))
  elif [ "$was_quiet" = yes ] && quiet; then
    fail "$1 took $2 ms, more than $3"
  else
    echo "$1 took $2 ms on a busy machine: not judged"
  fi
}

# For tests, or what is left of one, that are not about what is drawn: a gnuplot that takes no time, or $1 seconds in the
# midst of each picture, but none of the processor's. Before a command, `PATH=$with_gnuplot` brings the real one back, and
# PICTURE_TAKES gives other seconds, to what is killed as it draws.
with_gnuplot=$PATH
without_drawing() {
  mkdir bin
  export PICTURE_TAKES=${1:-0}
  cat >bin/gnuplot <<'END'
#!/bin/sh
# As the program calls it: -d [-c] ./STEM.gp [KIND]
kinds='png svg'
for word; do
  case $word in
    ./*.gp) stem=${word%.gp} ;;
    png | svg) kinds=$word ;;
  esac
done
for kind in $kinds; do
  case $kind in
    png) begun='a picture' end='IEND\256B`\202' ;;
    svg) begun='<svg>' end='</svg>' ;;
  esac
  {
    printf '%s %s' "$begun" "$stem"
    [ "$PICTURE_TAKES" = 0 ] || sleep "$PICTURE_TAKES"
    printf "$end"
  } >"$stem.$kind" || exit 1
done
END
  chmod +x bin/gnuplot
  export PATH=$work/bin:$PATH
}

# After that: the files of figure $1, a path without an end, are there, and of its script the real gnuplot makes whole
# pictures, elsewhere.
is_drawn() {
  local kind stem=${1##*/}
  for kind in png svg gp dat; do [ -s "$1.$kind" ] || fail "$1.$kind is missing"; done
  mkdir -p redrawn && cp "$1".{gp,dat} redrawn
  (cd redrawn && PATH=$with_gnuplot gnuplot -d "./$stem.gp") >drawing 2>&1 || fail "gnuplot on $1.gp: $(<drawing)"
  tail -c 8 "redrawn/$stem.png" | grep -qa IEND || fail "$1.gp makes no whole picture, PNG"
  tail -n 2 "redrawn/$stem.svg" | grep -q '</svg>' || fail "$1.gp makes no whole picture, SVG"
  rm -r redrawn
}

# $2 holds what $1 holds, but for what tells of the session, and is complete.
same_folder() {
  local difference
  difference=$(diff -r -q -x run.json -x .lock -x 'journal*' "$1" "$2") || fail "$2 differs from $1: $difference"
  grep -q '"state": "complete"' "$2/run.json" || fail "$2: run.json does not say complete"
}

# Kills a study that writes into folder $1 again and again until it ends by itself: each time within $2 milliseconds after
# its journals have grown, so that each session keeps something, however slow the build or the machine is.
killed_until_done() {
  local folder=$1 within=$2 code kills=0 before pid
  shift 2
  for ((; kills < 1000; ++kills)); do
    before=$(journal_bytes "$folder")
    "$@" >stdout 2>stderr </dev/null &
    pid=$!
    while [ "$(journal_bytes "$folder")" -le "$before" ] && kill -0 $pid 2>/dev/null; do sleep 0.02; done
    sleep "$(moment "$within")"
    kill -KILL $pid 2>/dev/null || true
    code=0
    { wait $pid || code=$?; } 2>/dev/null
    [ "$code" != 0 ] || break
    [ "$code" = 137 ] || fail "killed, it ended with $code: $(<stderr)"
  done
  [ "$code" = 0 ] || fail "not done after $kills kills"
  [ "$kills" -gt 0 ] || fail "no run was killed"
}

# Size of all journals in a folder.
journal_bytes() { { find "$1" -name 'journal*' -printf '%s\n' 2>/dev/null || true; } | awk '{ sum += $1 } END { print sum + 0 }'; }

# A random moment in seconds, up to $1 milliseconds.
moment() {
  local ms=$((RANDOM % $1))
  printf '%d.%03d' $((ms / 1000)) $((ms % 1000))
}

# The good records of a journal from its first one on, a line each: end in bytes, point, CRC. A reader of its own, after the layout
# in lib/store/journal.hpp.
journal_records() {
  perl -e '
    my @table = map { my $c = $_; $c = $c & 1 ? $c >> 1 ^ 0xedb88320 : $c >> 1 for 1 .. 8; $c } 0 .. 255;
    sub crc { my $c = 0xffffffff; $c = $c >> 8 ^ $table[($c ^ $_) & 255] for unpack "C*", $_[0]; $c ^ 0xffffffff }
    open my $file, "<:raw", $ARGV[0] or exit;
    local $/;
    my $bytes = <$file> // "";
    my $at = 84;
    exit if length $bytes < $at || crc(substr $bytes, 0, 80) != unpack "V", substr $bytes, 80;
    while (length $bytes >= $at + 20) {
      my ($letters, $length, $point) = unpack "a4 V Q<", substr $bytes, $at;
      last if $letters ne "EPJR" || length $bytes < $at + 20 + $length;
      my $crc = unpack "V", substr $bytes, $at + 16 + $length, 4;
      last if $crc != crc(substr $bytes, $at, 16 + $length);
      $at += 20 + $length;
      print "$at $point $crc\n";
    }' "$1"
}

# Starts two ranks of a command in the background, kills one of them at some moment, and waits for the end.
# $1: which; `launch` is theirs. Of a short study: soon after the journals in the folder `kill_after` have a record.
kill_a_rank_of() {
  local victim=$1 pid guard ranks
  shift
  "${launch[@]}" -n 2 "$@" --threads 1 >stdout 2>stderr &
  pid=$!
  if [ -n "${kill_after:-}" ]; then
    until [ "$(journal_bytes "$kill_after")" -gt 200 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
    sleep "$(moment 200)"
  else
    sleep "0.$((RANDOM % 6 + 3))"
  fi
  # The ranks are children of mpirun, in order.
  mapfile -t ranks < <(pgrep -P $pid -x epicyclic || true)
  [ ${#ranks[@]} -le "$victim" ] || kill -KILL "${ranks[$victim]}" 2>/dev/null || true
  # Open MPI has been seen to lock up in its own end after that, for ever.
  (sleep 100 && kill -KILL $pid) 2>/dev/null &
  guard=$!
  wait $pid || true
  pkill -P $guard 2>/dev/null || true
}
