#!/usr/bin/env bash
# first_second.sh EPICYCLIC SOURCE_DIR
#
# Each command stopped in its first second: by SIGINT, SIGTERM and SIGHUP, after multiples of 10 ms, DELAYS of them (4, with
# sanitizers 2) for each command, shifted by SEED; 100 are all. It ends with 75 and says that the same
# command goes on, or by the signal before anything was written, or it was done; no temporary file is left; the same command
# then ends as one that was not stopped.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing 0.02

delays=${DELAYS:-$(or_if_slow 4 2)}
seed=${SEED:-$RANDOM}
RANDOM=$seed
echo "DELAYS=$delays SEED=$seed"

few=(--set /study/transient_periods=200 --set /study/recorded_periods=32 --set /study/classification_periods=64)
small="$inputs/../tests/cli/claims.sh"
sed -n '/^cat >claims.json/,/^END$/p' "$small" >make_claims && source make_claims

# What the others are of.
"$epicyclic" sweep "${speeds[@]}" --set /study/points=4 --set /study/transient_periods=2 --set /study/recorded_periods=4 \
  --set /study/classification_periods=0 -o swept >/dev/null 2>stderr || fail "the sweep: $(<stderr)"
flip=("$inputs/tang2020_branches.json" --set /study/from=2.14 --set /study/to=2.16 --set '/study/starts=[2.155]' --set /study/period_max=1
  --set /study/tolerance=1e-8)
"$epicyclic" continue "${flip[@]}" -o branched >/dev/null 2>stderr || fail "the branches: $(<stderr)"
"$epicyclic" assert branched expected.json --record >/dev/null 2>stderr || fail "the expected points: $(<stderr)"

init=(init out --teeth 21,28,77 --module 3)
gear=(gear "$inputs/tang2020.json" -o out)
run=(run "$inputs/tang2020_run.json" --set /operation/mesh_frequency_ratio=2.8 "${few[@]}" --set /study/exponent_periods=40
  --set /study/check_tolerance=1e-6 --set /study/spectrum_periods=16 --set /study/history_periods=2 -o out)
sweep=(sweep "${speeds[@]}" --set /study/points=6 "${few[@]}" -o out)
continue=(continue "${flip[@]}" -o out)
map=(map "$inputs/tang2020_map.json" --set /study/first/points=4 --set /study/second/points=3 "${few[@]}" -o out)
basins=(basins "$inputs/tang2020_basins.json" --set /study/transient=fixed --set /study/first/points=4 --set /study/second/points=3 "${few[@]}" -o out)
tolerance=(tolerance "$inputs/tang2020_tolerance.json" --set /study/points=1 --set /study/from=2.8 --set /study/to=2.8 "${few[@]}"
  --set '/study/methods=["arkode-dopri5"]' --set '/study/tolerances=[1e-5, 1e-6]' --set /study/chaotic_periods=64 -o out)
crosscheck=(crosscheck "$inputs/tang2020_crosscheck.json" --set /study/points=2 "${few[@]}" --set '/study/methods=["arkode-dopri5", "cvode-adams"]' -o out)
ramp=(ramp "$inputs/tang2020_ramp.json" --set /study/rate_per_tau=0.002 -o out)
reproduce=(reproduce claims.json -o out)
calibrate=(calibrate claims.json -o out)
robustness=(robustness claims.json -o out)
assert=(assert branched expected.json --junit verdicts.xml)
record=(assert branched out.json --record)
plot=(plot swept branched --quantity delta_sp_max -o out)
check=(check "$inputs/tang2020_speed.json" --threads 1)
keys=(keys)
schema=(schema)
commands=(init gear run ramp sweep continue map basins tolerance crosscheck assert record plot check keys schema)
! has_claims || commands+=(reproduce calibrate robustness)
signals=(INT TERM HUP)
numbers=(2 15 1)

# As a figure may still come, twice.
clean() { rm -rf out out.json verdicts.xml .*.tmp 2>/dev/null || { sleep 1; rm -rf out out.json verdicts.xml .*.tmp; }; }
is_any_there() { [ -e out ] || [ -e out.json ] || [ -e verdicts.xml ]; }

# Starts what follows, sends it a signal after so many milliseconds, and sets code. Jobs in the background would ignore SIGINT.
stopped_after() {
  local ms=$1 signal=$2 pid
  env --default-signal "${@:3}" >stdout 2>stderr </dev/null &
  pid=$!
  sleep "$(printf '%d.%03d' $((ms / 1000)) $((ms % 1000)))"
  kill -s "$signal" $pid 2>/dev/null || true
  code=0
  { wait $pid || code=$?; } 2>/dev/null
}

count=0
early=0
for command in "${commands[@]}"; do
  declare -n arguments=$command
  clean
  whole=$(code_of "$epicyclic" "${arguments[@]}")
  [ "$whole" -le 1 ] || fail "$command: exit code $whole: $(<stderr)"
  last=none
  for ((k = 0; k < delays; ++k)); do
    part=$(((k * 100 + RANDOM % 100) / delays))
    [ "$delays" -ge 100 ] || part=$((part * part / 100)) # most of them where inputs are read and folders are made
    ms=$((10 * part))
    which=$((RANDOM % 3))
    what="$command, SIG${signals[which]} after $ms ms"
    clean
    stopped_after $ms "${signals[which]}" "$epicyclic" "${arguments[@]}"
    case $code in
      75) grep -q 're-run the same command to resume' stderr || fail "$what: does not say that it goes on: $(<stderr)" && last=$what ;;
      $((128 + numbers[which]))) if is_any_there; then fail "$what: ended by the signal, with files written"; fi ;;
      "$whole") early=$((early + 1)) ;;
      *) fail "$what: exit code $code: $(<stderr)" ;;
    esac
    case $command in
      init) [ "$code" = 0 ] || [ ! -e out/stage.json ] || fail "$what: leaves files that it would not write over" ;;
      assert | record | plot) [ -z "$(find . -path ./swept -prune -o -path ./branched -prune -o -name '.*.tmp' -print)" ] || fail "$what: leaves temporary files" ;;
    esac
    count=$((count + 1))
  done
  # The last one goes on to its end.
  code=$(code_of "$epicyclic" "${arguments[@]}")
  [ "$code" = "$whole" ] || { [ "$code" = 2 ] && grep -q ': exists; ' stderr; } || fail "$command, again after $last: exit code $code: $(<stderr)"
done
echo "$count stops of ${#commands[@]} commands, $early of them too late"
finish
