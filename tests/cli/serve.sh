#!/usr/bin/env bash
# serve.sh EPICYCLIC SOURCE_DIR
#
# `serve`: what it answers and what not, 500 hostile requests, a study that grows, a region computed finer, cancelled,
# killed and resumed, the end by a signal, bad command lines.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source "$2/tests/cli/report_studies.bash"

mkdir empty
refused() {
  local words=$1
  shift
  [ "$(code_of "$epicyclic" serve "$@")" = 2 ] || fail "serve $*: $(<stderr)"
  grep -qF -- "$words" stderr || fail "serve $*: $(<stderr)"
}
refused 'FOLDER is required'
refused 'nowhere: is not a folder' nowhere
refused 'empty: contains no study' empty
refused '--port' empty --port 70000

make_sweep sweep
if [ "$(code_of timeout 1 "$epicyclic" serve sweep)" = 2 ]; then
  grep -qF 'was built without cpp-httplib' stderr || fail "without HTTP: $(<stderr)"
  skip "built without cpp-httplib"
fi
[ "$("$epicyclic" serve sweep 2>stderr >/dev/full; echo $?)" = 5 ] || fail "no place for its address: $(<stderr)"
make_unfinished
cp -r sweep before
python3 "$2/tests/cli/serve.py" "$epicyclic" "$(or_if_slow 1 20)" || failed=$((failed + 1))
# Folders of its own, and nothing else of the study is another.
[ "$(diff -rq before sweep)" = "$(printf 'Only in sweep: changed\nOnly in sweep: refined')" ] || fail "the study was changed: $(diff -rq before sweep)"
finish
