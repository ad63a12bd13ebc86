#!/usr/bin/env bash
# check.sh EPICYCLIC SOURCE_DIR
#
# `check` answers within 5 s, whatever the points take: of a run with many exponents, of points that take minutes, and where one
# mesh period takes minutes. What is known is printed first; what was not measured to its end gives a lower bound. On a busy
# machine the time is not judged, but a minute is too long.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

most_ms=5000
# $1: what it is, $2: a pattern of its time; the rest: the study.
answers() {
  local begun code=0
  await_quiet
  begun=$(date +%s%3N)
  timeout -s KILL "$(or_if_slow 60 600)" "$epicyclic" check --json "${@:3}" --threads 2 >stdout 2>stderr </dev/null || code=$?
  judge_time "$1" $(($(date +%s%3N) - begun)) $most_ms
  [ "$code" = 0 ] || fail "$1: exit code $code: $(<stderr)"
  grep -q '"study": {' stdout || fail "$1: the resolved input is not printed"
  grep -q ': valid$' stderr && grep -q '^cost: [0-9]* points in [0-9]* chains, [0-9]* mesh periods' stderr || fail "$1: what is known is not said: $(<stderr)"
  [ -z "$2" ] || grep -qE "^time: $2" stderr || fail "$1: $(<stderr)"
}

"$epicyclic" init slow >/dev/null 2>&1
answers "a run with many exponents" 'about .* on 1 thread .*, by [0-9]+ of 1000050 mesh periods of its exponents' slow/point.json --set /study/exponent_periods=1000000
slowly=(--set /integrator/max_steps_per_period=1000000000 --set /integrator/relative_tolerance=1e-13)
answers "points that take minutes" 'more than .* on 2 threads .*, by what 0 of [0-9]+ points took that were tried for 4 s' "${speeds[@]}" \
  "${slowly[@]}" --set /study/transient=fixed --set /study/transient_periods=1000000
answers "mesh periods that take minutes" '' "${speeds[@]}" "${slowly[@]}" --set /study/from=1e-5 --set /study/to=2e-5
grep -q '^cost: .*; the cost is not known: a few mesh periods exceed' stderr || fail "not said that a mesh period takes long: $(<stderr)"
finish
