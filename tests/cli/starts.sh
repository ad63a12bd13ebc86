#!/usr/bin/env bash
# starts.sh EPICYCLIC SOURCE_DIR
#
# STARTS (100) simultaneous starts of one command on one folder that is not there yet: one computes, the others find the
# folder in use (4) or complete (0), and the results are those of a single run.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

starts=${STARTS:-100}
study=("${speeds[@]}" --set /study/points=4 --set /study/transient_periods=60 --set /study/recorded_periods=8
  --set /study/classification_periods=64 --threads 1)
[ "$(code_of "$epicyclic" sweep "${study[@]}" -o single)" = 0 ] || fail "a single run: $(<stderr)"

# They wait for a lock, so that they begin together.
exec 8>gate
flock 8
pids=()
for k in $(seq "$starts"); do
  (flock -s 9 && exec 9>&- && exec "$epicyclic" sweep "${study[@]}" -o folder) 9<gate 8>&- >"stdout.$k" 2>"stderr.$k" </dev/null &
  pids+=($!)
done
exec 8>&-
in_use=0
finished=0
for k in $(seq "$starts"); do
  code=0
  wait "${pids[k - 1]}" || code=$?
  case $code in
    0) finished=$((finished + 1)) ;;
    4) in_use=$((in_use + 1)) ;;
    *) fail "start $k: exit code $code: $(<"stderr.$k")" ;;
  esac
done
winners=$(cat stdout.* | grep -c ' points, 0 failed, in folder' || true)
[ "$winners" = 1 ] || fail "$winners starts computed"
[ "$((finished - winners))" = "$(cat stderr.* | grep -c 'complete already')" ] || fail "one ended with 0 without computing or finding it complete"
[ "$in_use" = "$(cat stderr.* | grep -c 'in use')" ] || fail "one ended with 4 without saying so"
[ "$in_use" -gt 0 ] || fail "no start met another"
same_results single folder
echo "$starts starts: $winners computed, $in_use found it in use, $((finished - winners)) complete"
finish
