#!/usr/bin/env bash
# kills.sh EPICYCLIC SOURCE_DIR
#
# kill -9 at random moments: KILLS of them (16, with sanitizers 8), seeded by SEED, over sweeps with 1, 2 and 8 threads,
# with one trajectory at a time and in lanes; of fresh runs, of resumed ones, and while the results are written. Whatever
# record was in the journal stays, no point is computed twice, the same command ends with the same bytes, nothing is done by
# hand. Some kills are followed by half a record, which only the death of a machine leaves. Of 100 kills and more some meet
# the real gnuplot, of fewer one that is slow in the midst of each picture.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
command -v perl >/dev/null || skip "there is no perl to read the journal with"

kills=${KILLS:-$(or_if_slow 16 8)}
seed=${SEED:-$RANDOM}
RANDOM=$seed
echo "KILLS=$kills SEED=$seed"

points=20
study=("${speeds[@]}" --set "/study/points=$((points / 2))"
  --set "/study/transient_periods=$(or_if_slow 60 20)" --set /study/recorded_periods=8
  --set "/study/classification_periods=$(or_if_slow 64 0)")
methods=(arkode-dopri5 lanes-dopri5)
threads=(1 2 8)
# Longest time to a kill: about that of a whole run on a small machine, so that some are killed as they start and some as they end.
longest_ms=1000
[ "$kills" -ge 100 ] || { without_drawing 0.1 && longest_ms=500; }

for method in "${methods[@]}"; do
  [ "$(code_of "$epicyclic" sweep "${study[@]}" --set "/integrator/method=$method" -o "$method")" = 0 ] || fail "$method: $(<stderr)"
done

# $2 begins with all that $1 holds.
begins_with() { cmp -s -n "$(stat -c %s "$1")" "$1" "$2"; }

# What is lost and computed again has the same bytes: the program's own word tells.
took_up() {
  local count
  count=$(wc -l <records)
  [ "$count" = 0 ] || ! grep -q '^sweep ' stderr || grep -q "$count of $points points exist already" stderr ||
    fail "$what: $count records were there, but: $(grep 'there already' stderr)"
}

killed=0
resumed=0
written=0
torn=0
rounds=0
while [ "$killed" -lt "$kills" ]; do
  method=${methods[rounds % 2]}
  count=${threads[rounds / 2 % 3]}
  command=("$epicyclic" sweep "${study[@]}" --set "/integrator/method=$method" --threads "$count" -o "round$rounds")
  folder=round$rounds
  rounds=$((rounds + 1))
  what="round $rounds ($method, $count threads)"
  : >records
  for ((left = 1 + RANDOM % 6; left > 0 && killed < kills; --left)); do
    "${command[@]}" >stdout 2>stderr &
    pid=$!
    if [ $((RANDOM % 4)) = 0 ]; then # while the results are written
      until compgen -G "$folder/.points.csv.*.tmp" >/dev/null || [ -e "$folder/points.csv" ]; do
        kill -0 "$pid" 2>/dev/null || break
        sleep 0.002
      done
      sleep "$(moment 500)"
    else
      sleep "$(moment $longest_ms)"
    fi
    cp "$folder/journal.bin" before 2>/dev/null || : >before
    kill -KILL "$pid" 2>/dev/null || true
    code=0
    wait "$pid" 2>/dev/null || code=$?
    journal_records before >records_before
    journal_records "$folder/journal.bin" >records_now
    begins_with records records_now || fail "$what: records of an earlier run are gone"
    begins_with records_before records_now || fail "$what: records that were there before the kill are gone"
    took_up
    if [ -s records ]; then resumed=$((resumed + 1)); fi
    mv records_now records
    if [ "$code" = 0 ]; then break; fi
    [ "$code" = 137 ] || fail "$what: exit code $code: $(<stderr)"
    killed=$((killed + 1))
    if [ "$(wc -l <records)" = $points ]; then written=$((written + 1)); fi
    if [ -s records ] && [ $((RANDOM % 4)) = 0 ]; then
      head -c $((85 + RANDOM % 2000)) "$method/journal.bin" | tail -c +85 >>"$folder/journal.bin"
      torn=$((torn + 1))
    fi
  done
  [ "$(code_of "${command[@]}")" = 0 ] || fail "$what: the same command: $(<stderr)"
  took_up
  journal_records "$folder/journal.bin" >records_now
  begins_with records records_now || fail "$what: the last run lost records"
  [ "$(cut -d ' ' -f 2 records_now | sort -n)" = "$(seq 0 $((points - 1)))" ] || fail "$what: a point is missing or was computed twice"
  same_results "$method" "$folder"
  ! compgen -G "$folder/.*.tmp" >/dev/null || fail "$what: temporary files are left"
  rm -rf "$folder" 2>/dev/null || true
done
echo "$killed kills in $rounds folders: $resumed of resumed runs, $written after the last point; $torn torn tails"
finish
