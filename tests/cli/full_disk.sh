#!/usr/bin/env bash
# full_disk.sh EPICYCLIC SOURCE_DIR
#
# A file system of 1 MiB: exit 5 and what to do, nothing of the journal lost; with room made, the same command ends with the same
# bytes. Also where the journal fits and the results do not, each size of a row failing somewhere else.
set -euo pipefail
# In a namespace of its own, whose file systems go with it.
if [ "${OWN_NAMESPACE:-}" != yes ] && unshare -rm true 2>/dev/null; then OWN_NAMESPACE=yes exec unshare -rm bash "$0" "$@"; fi
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
command -v perl >/dev/null || skip "there is no perl to read the journal with"
[ "${OWN_NAMESPACE:-}" = yes ] || skip "namespaces are not allowed here"
mkdir disk
mount -t tmpfs -o size=1m epicyclic disk 2>/dev/null || skip "a tmpfs cannot be mounted here"
trap 'umount "$work/disk"; rm -rf "$work"' EXIT

study() { "$epicyclic" sweep "${speeds[@]}" --set /study/transient_periods=8 --set "/study/classification_periods=$1" "${@:2}"; }

# $1 classification periods, $2 points, $3 recorded periods, $4 sizes in KiB, rising; the last one suffices
series() {
  local options=("$1" --set "/study/points=$2" --set "/study/recorded_periods=$3") size code
  local last=${4##* }
  [ "$(code_of study "${options[@]}" -o "whole$2")" = 0 ] || fail "$2 points: $(<stderr)"
  : >records
  for size in $4; do
    mount -o "remount,size=${size}k" disk
    code=$(code_of study "${options[@]}" -o "disk/$2" --threads 2)
    echo "$2 points, $size KiB: exit code $code: $(tail -n 1 stderr)"
    journal_records "disk/$2/journal.bin" >records_now
    cmp -s -n "$(stat -c %s records)" records records_now || fail "$2 points, $size KiB: records are gone"
    mv records_now records
    [ "$size" != "$last" ] || break
    [ "$code" = 5 ] || fail "$2 points, $size KiB: exit code $code, not 5"
    grep -q 'make room and repeat the command' stderr || fail "$2 points, $size KiB does not say what to do"
  done
  [ "$code" = 0 ] || fail "$2 points: with room made, exit code $code"
  same_results "whole$2" "disk/$2"
  [ -s "disk/$2/figures/bifurcation_delta_sp.svg" ] || fail "$2 points: a figure is missing"
  rm -rf "disk/$2"
}

# 1.6 MB of journal: full in the midst of the computation.
series 0 20 128 "1024 16384"
# 0.15 MB of journal, 1.3 MB in all: full at any step of the writing.
series 64 24 8 "16 100 200 300 400 500 600 700 800 900 1000 1100 16384"
finish
