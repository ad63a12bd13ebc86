#!/usr/bin/env bash
# streams.sh EPICYCLIC SOURCE_DIR
#
# Standard streams that are closed, full, without a reader, with a reader that stands still, or files that may not grow: data
# that stdout does not take give exit 5, words that stderr does not take change nothing, and neither comes into a file of
# the study, which is whole in each case.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
command -v perl >/dev/null || skip "there is no perl to read the journal with"
without_drawing

few=(--set /study/points=2 --set /study/transient_periods=2 --set /study/recorded_periods=4 --set /study/classification_periods=0)
sweep=("$epicyclic" sweep "${speeds[@]}" "${few[@]}")
[ "$(code_of "${sweep[@]}" -o whole)" = 0 ] || fail "$(<stderr)"

# A pipe whose reader has gone, and one whose reader stands still: descriptors 8 and 9.
mkfifo gone still
exec 7<>gone 8>gone 7>&-
exec 9<>still
perl -e 'use Fcntl; open my $pipe, ">&=", 9; my $flags = fcntl $pipe, F_GETFL, 0; fcntl $pipe, F_SETFL, $flags | O_NONBLOCK;
  1 while syswrite $pipe, "x" x 4096; 1 while syswrite $pipe, "x"; fcntl $pipe, F_SETFL, $flags'
limit=1024 # KiB, more than any file of the study
head -c $((limit * 1024)) /dev/zero >grown

# Becomes what follows, with stdin, stdout and stderr as named, at most for a minute.
become() {
  ulimit -f $limit
  case $1 in closed) exec <&- ;; *) exec </dev/null ;; esac
  case $2 in
    closed) exec >&- ;;
    full) exec >/dev/full ;;
    gone) exec >&8 ;;
    grown) exec >>grown ;;
    *) exec >stdout ;;
  esac
  case $3 in
    closed) exec 2>&- ;;
    full) exec 2>/dev/full ;;
    gone) exec 2>&8 ;;
    grown) exec 2>>grown ;;
    still) exec 2>&9 ;;
    *) exec 2>stderr ;;
  esac
  exec 8>&- 9>&-
  exec timeout -s KILL 60 "${@:4}"
}
with_streams() {
  code=0
  (become "$@") || code=$?
}

combinations=0
for in in open closed; do
  for out in open closed full gone grown; do
    for err in open closed full gone grown still; do
      what="stdin $in, stdout $out, stderr $err"
      # Why data are lost is told in any case, and whoever reads slowly is waited for.
      [ $out = open ] || [ $err != still ] || continue
      rm -rf study
      with_streams $in $out $err "${sweep[@]}" -o study
      expected=5
      [ $out != open ] || expected=0
      [ "$code" = $expected ] || fail "$what: exit code $code, not $expected"
      [ $err != open ] || [ $expected = 0 ] || grep -q '^standard output: cannot write' stderr || fail "$what: not told: $(<stderr)"
      same_folder whole study
      [ "$(journal_records study/journal.bin | wc -l)" = 4 ] || fail "$what: the journal has other than 4 records"
      [ ! -s study/.lock ] || fail "$what: something stands in .lock"
      [ "$(code_of "${sweep[@]}" -o study)" = 0 ] || fail "$what: again: $(<stderr)"
      grep -q 'complete already' stderr || fail "$what: not complete: $(<stderr)"
      combinations=$((combinations + 1))
    done
  done
done

# Other commands: their codes do not depend on who listens to words, and data that are lost are an error.
mkdir foreign busy && echo mine >foreign/thesis.txt
exec 6>busy/.lock && flock 6
others=("0 check --no-time $inputs/tang2020_speed.json" "0 check $inputs/tang2020.json" "0 schema" "0 --version" "0 --help" "0 sweep --help"
  "0 gear $inputs/lin_parker_1999_n3.json -o gear.%" "2 sweep" "2 nonsense" "2 check none.json" "2 gear none.json -o none"
  "3 sweep $inputs/tang2020_speed.json -o foreign" "4 sweep $inputs/tang2020_speed.json -o busy")
for out in open closed full gone; do
  for err in open closed gone; do
    for other in "${others[@]}"; do
      read -r expected arguments <<<"${other//%/$out.$err}"
      [ $out = open ] || [ "$expected" != 0 ] || expected=5
      with_streams closed $out $err "$epicyclic" $arguments
      [ "$code" = "$expected" ] || fail "$arguments: stdout $out, stderr $err: exit code $code, not $expected"
      combinations=$((combinations + 1))
    done
  done
done
[ ! -e none ] || fail "something was written for bad input"
code=0
"$epicyclic" schema 2>stderr | head -n 1 >stdout || code=${PIPESTATUS[0]}
[ "$code" = 5 ] || [ "$code" = 0 ] || fail "schema, of which one line is read: exit code $code"

# A terminal obeys no text of an input or of a name: control characters are shown, and JSON keeps them.
control=$'[\x01-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]'
study_of() {
  printf '{ "stage": "%s", "name": "a\\u001b]0;b\\u0007\\u009bc\\u007f\\u000d\\u0001", %s "study": { "kind": "sweep" } }' "$inputs/tang2020.json" "$1" >control.json
}
study_of '"na\u001b[2Jme": 1,'
[ "$(code_of "$epicyclic" check control.json)" = 2 ] || fail "an unknown key: $(<stderr)"
! LC_ALL=C grep -qP "$control" stderr || fail "control characters of a key reach the terminal: $(<stderr)"
grep -qF 'na\u001b[2Jme' stderr || fail "the key is not shown: $(<stderr)"
study_of ''
[ "$(code_of "$epicyclic" check control.json --no-time --json)" = 0 ] || fail "a name with control characters: $(<stderr)"
! LC_ALL=C grep -qP "$control" stdout || fail "control characters of a name reach the terminal: $(LC_ALL=C grep -P "$control" stdout)"
grep -qF '"name": "a\u001b]0;b\u0007\u009bc\u007f\r\u0001"' stdout || fail "the name is another one: $(grep '"name"' stdout)"
[ "$(code_of "$epicyclic" check $'no\e[31mfile.json')" = 2 ] || fail "a name of a file: $(<stderr)"
! LC_ALL=C grep -qP "$control" stderr || fail "control characters of a name of a file reach the terminal: $(<stderr)"

# Stopped, with words that nobody takes.
long=("${sweep[@]}" --set /study/transient_periods=100000)
for err in closed full gone grown still; do
  rm -rf study
  (become open open $err "${long[@]}" -o study) &
  pid=$!
  until [ -s study/journal.bin ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
  kill -TERM $pid
  code=0
  wait $pid || code=$?
  [ "$code" = 75 ] || fail "SIGTERM, stderr $err: exit code $code, not 75"
  grep -q '"state": "stopped"' study/run.json || fail "SIGTERM, stderr $err: not stopped: $(<study/run.json)"
done
echo "$combinations combinations"
finish
