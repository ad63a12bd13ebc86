#!/usr/bin/env bash
# report.sh EPICYCLIC SOURCE_DIR
#
# `report`: pages of finished and unfinished studies, the same bytes again, nothing but text of names, bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source "$2/tests/cli/report_studies.bash"

make_sweep sweep
make_unfinished
cp -r sweep before

# By default into the folder, which stays the study that it was.
[ "$(code_of "$epicyclic" report sweep)" = 0 ] || fail "report: $(<stderr)"
[ "$(<stdout)" = "report: sweep/report.html" ] || fail "what it says: $(<stdout)"
[ -s sweep/report.html ] || fail "no page"
[ "$(diff -rq before sweep)" = "Only in sweep: report.html" ] || fail "the study was changed: $(diff -rq before sweep)"
[ "$(code_of "$epicyclic" sweep sweep/input.resolved.json -o sweep)" = 0 ] || fail "the folder is not its study's any more: $(<stderr)"

# With --report a study writes its page itself, and names it last; also when it is complete already.
cp -r before finished
for place in finished/input.resolved.json sweep/input.resolved.json; do
  [ "$(code_of "$epicyclic" sweep "$place" -o "${place%%/*}" --report)" = 0 ] || fail "sweep --report: $(<stderr)"
  [ "$(tail -n 1 stdout)" = "open ${place%%/*}/report.html" ] || fail "the last line: $(<stdout)"
done
[ -s finished/report.html ] || fail "no page of a complete study"
[ "$(code_of "$epicyclic" sweep sweep/input.resolved.json -o sweep --report --json)" = 0 ] || fail "with --json: $(<stderr)"
! grep -q '^open ' stdout || fail "another line beside the JSON: $(<stdout)"

# The same bytes again, on another day and with one thread.
sleep 1
[ "$(code_of taskset -c 0 "$epicyclic" report sweep -o again.html --json)" = 0 ] || fail "again: $(<stderr)"
grep -q '"report": "again.html"' stdout || fail "JSON: $(<stdout)"
cmp sweep/report.html again.html || fail "another page of the same folder"

# No address of a network is fetched: none stands in an attribute, and the policy forbids all.
grep -qE "(src|href)=[\"']?(https?:)?//" again.html && fail "the page leads out"
grep -qF "default-src 'none'; script-src 'sha256-" again.html || fail "no policy"
[ "$(stat -c %s again.html)" -lt 1000000 ] || fail "$(stat -c %s again.html) bytes for 18 points"

# Several folders on one page; a study that is not complete.
[ "$(code_of "$epicyclic" report sweep unfinished -o several.html)" = 0 ] || fail "two folders: $(<stderr)"
[ "$(code_of "$epicyclic" report unfinished -o unfinished.html)" = 0 ] || fail "an unfinished study: $(<stderr)"
[ ! -e unfinished/report.html ] || fail "a page at a place that nobody gave"

# Files of others are those that the table of their folder names.
grep -E '^[0-9a-f]{64}  uPlot' "$2/app/browser/vendor/README.md" >hashes
[ "$(wc -l <hashes)" = 2 ] || fail "the table of files of others: $(<hashes)"
(cd "$2/app/browser/vendor" && sha256sum --quiet --check "$work/hashes") || fail "a file of others is another one"

# Names are text.
make_sweep hostile --set "/name=$(printf '%s' "$hostile_name" | sed 's/"/\\"/g; s/^/"/; s/$/"/')" --set /study/points=3
[ "$(code_of "$epicyclic" report hostile -o hostile.html)" = 0 ] || fail "a hostile name: $(<stderr)"
grep -q '<img' hostile.html && fail "a name is markup"
grep -q '<title>&lt;img src=x onerror=&quot;' hostile.html || fail "the title: $(grep -o '<title>.*</title>' hostile.html)"

# Bad input: one message, no page.
refused() {
  local code=$1 words=$2
  shift 2
  [ "$(code_of "$epicyclic" report "$@")" = "$code" ] || fail "report $*: $(<stderr)"
  grep -qF -- "$words" stderr || fail "report $*: $(<stderr)"
  [ ! -e refused.html ] || fail "report $*: a page"
}
mkdir empty
refused 2 'FOLDER is required' -o refused.html
refused 2 'nowhere: is not a folder' nowhere -o refused.html
refused 2 'stderr: is not a folder' stderr -o refused.html
refused 2 'empty: contains no study' empty -o refused.html
refused 2 'must end with .html' sweep -o sweep/points.csv
refused 2 'its folder does not exist' sweep -o no/refused.html
mkdir folder.html
refused 2 'is a folder' sweep -o folder.html
cp -r unfinished nothing && rm nothing/journal.bin
refused 2 'nothing of it can be shown yet' nothing -o refused.html
cp -r sweep changed && echo >>changed/points.csv
refused 7 'points.csv was changed' changed -o refused.html
cp -r sweep cut && truncate -s 1000 cut/journal.bin
refused 7 'journal' cut -o refused.html
ln -s /dev/full full.html
[ "$(code_of "$epicyclic" report sweep -o full.html)" = 5 ] || fail "a device: $(<stderr)"
finish
