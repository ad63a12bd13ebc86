#!/usr/bin/env bash
# live.sh EPICYCLIC SOURCE_DIR
#
# Pages of `serve` in a headless Chromium, as live.mjs reads them. Skipped where Chromium, Node.js or HTTP is missing.
set -euo pipefail
source "$2/tests/cli/common.bash"
source "$2/tests/browser/browser.bash"
source "$2/tests/cli/report_studies.bash"

make_sweep sweep
"$epicyclic" serve sweep --threads 2 >served 2>served.err &
server=$!
for ((k = 0; k < 200; ++k)); do
  [ ! -s served ] || break
  kill -0 $server 2>/dev/null || { grep -q 'without cpp-httplib' served.err && skip "built without cpp-httplib"; fail "serve: $(<served.err)"; finish; }
  sleep 0.05
done
# A study that another process computes.
"$epicyclic" sweep sweep/input.resolved.json --set /study/points=600 --threads 1 -o growing >/dev/null 2>&1 &
writer=$!
while [ ! -s growing/journal.bin ]; do sleep 0.05; done
"$epicyclic" serve growing >growing.served 2>/dev/null &
second=$!
while [ ! -s growing.served ]; do sleep 0.05; done
study map "$inputs/tang2020_map.json" -o map --set /study/first/points=3 --set /study/second/points=2 "${few[@]}"
"$epicyclic" serve map >map.served 2>/dev/null &
third=$!
while [ ! -s map.served ]; do sleep 0.05; done
node "$2/tests/browser/live.mjs" "$chromium" "$(sed 's/^open //' served)" "$(sed 's/^open //' growing.served)" \
  "$(sed 's/^open //' map.served)" $server || fail "the pages"
kill $server $second $third $writer 2>/dev/null || true
wait || true
finish
