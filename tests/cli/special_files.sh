#!/usr/bin/env bash
# special_files.sh EPICYCLIC SOURCE_DIR
#
# A FIFO, a socket, a device or a folder where a study's run.json or journal.bin is expected: refused at once with 7 and what
# it is, whoever reads it, and left as it is. A donor whose run.json is none is bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

few=(--set /study/points=2 --set /study/transient_periods=2 --set /study/recorded_periods=4 --set /study/classification_periods=0)
sweep=("$epicyclic" sweep "${speeds[@]}" "${few[@]}")
[ "$(code_of "${sweep[@]}" -o whole)" = 0 ] || fail "$(<stderr)"
# As a session leaves it that was killed.
cp -r whole begun
sed -i 's/"state": "complete"/"state": "running"/' begun/run.json

declare -A kinds=([fifo]='a FIFO' [socket]='a socket' [folder]='a folder' [device]='a device')
make_special() {
  rm -f "$2"
  case $1 in
    fifo) mkfifo "$2" ;;
    socket) perl -MIO::Socket::UNIX -e 'IO::Socket::UNIX->new(Local => $ARGV[0], Listen => 1) or die' "$2" ;;
    folder) mkdir "$2" ;;
    device) ln -s /dev/zero "$2" ;;
  esac
}
at_once() { timeout -s KILL 20 "$@"; }

for kind in "${!kinds[@]}"; do
  for file in run.json journal.bin; do
    what="$kind as $file"
    rm -rf study
    cp -r begun study
    make_special "$kind" "study/$file"
    [ "$(code_of at_once "${sweep[@]}" -o study)" = 7 ] || fail "$what: $(<stderr)"
    grep -q "study/$file: is ${kinds[$kind]}.*, not a file" stderr || fail "$what: not said what it is: $(<stderr)"
    [ ! -f "study/$file" ] || fail "$what: was replaced"
    # As a donor, whose journal is read.
    rm -rf study
    cp -r whole study
    make_special "$kind" "study/$file"
    code=$(code_of at_once "$epicyclic" run --from study:0 -o point --set /study/exponent_periods=0)
    case $file:$code in
      run.json:2 | journal.bin:7) ;;
      *) fail "a donor with a $what: exit code $code: $(<stderr)" ;;
    esac
  done
done
finish
