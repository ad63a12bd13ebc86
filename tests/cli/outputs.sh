#!/usr/bin/env bash
# outputs.sh EPICYCLIC SOURCE_DIR
#
# Complete folders whose files were removed, cut, emptied or changed, of each command: the same command makes all of them
# again, the same bytes, and keeps what it cannot know to be a mere beginning of them. Pictures that could not be drawn are
# drawn once gnuplot is there. And a cut tail of the journal is told.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

few=(--set /study/transient_periods=2 --set /study/recorded_periods=8 --set /study/classification_periods=0)
sweep=(sweep "${speeds[@]}" --set /study/points=2 "${few[@]}")
map=(map "$inputs/tang2020_map.json" --set /study/first/points=2 --set /study/second/points=2 "${few[@]}")
basins=(basins "$inputs/tang2020_basins.json" --set /study/transient=fixed --set /operation/mesh_frequency_ratio=2.8 --set /study/first/points=2
  --set /study/second/points=2 --set /study/transient_periods=20 --set /study/recorded_periods=8)
gear=(gear "$inputs/tang2020.json")
run=(run "$inputs/tang2020_run.json" --set /operation/mesh_frequency_ratio=2.8 --set /study/recorded_periods=16
  --set /study/transient_periods=2 --set /study/exponent_periods=12 --set /study/check_tolerance=1e-6 --set /study/spectrum_periods=16 --set /study/history_periods=2)
cat >crosscheck.json <<END
{ "stage": "$inputs/tang2020.json",
  "study": { "kind": "crosscheck", "from": 2.6, "to": 2.8, "points": 2, "transient_periods": 4, "recorded_periods": 8,
             "methods": ["arkode-dopri5", "cvode-adams"] } }
END
crosscheck=(crosscheck crosscheck.json)
cat >tolerance.json <<END
{ "stage": "$inputs/tang2020.json",
  "study": { "kind": "tolerance", "from": 2.8, "to": 2.8, "points": 1, "transient_periods": 20, "recorded_periods": 8,
             "methods": ["arkode-dopri5"], "tolerances": [1e-5, 1e-6], "clearance_smoothings": [0.05, 0.02],
             "chaotic_periods": 64 } }
END
tolerance=(tolerance tolerance.json)

# First without a gnuplot: all else is there, and the folder is complete.
no_gnuplot=$work/none
mkdir "$no_gnuplot"
[ "$(PATH=$no_gnuplot code_of "$epicyclic" "${sweep[@]}" -o undrawn)" = 1 ] || fail "without gnuplot: $(<stderr)"
[ "$(PATH=$no_gnuplot code_of "$epicyclic" "${sweep[@]}" -o undrawn)" = 1 ] || fail "without gnuplot, again: $(<stderr)"
grep -q 'complete already' stderr || fail "without gnuplot not complete: $(<stderr)"
without_drawing
[ "$(code_of "$epicyclic" "${sweep[@]}" -o undrawn)" = 0 ] || fail "with gnuplot: $(<stderr)"
grep -q 'was not drawn' stderr || fail "with gnuplot: not said what is made again: $(<stderr)"

# Does to file $1 the $2-th of what can be done to it.
damage() {
  local size
  size=$(stat -c %s "$1")
  case $(($2 % 4)) in
    0) rm "$1" ;;
    1) truncate -s $((size / 2)) "$1" ;;
    2) : >"$1" ;;
    3) printf 'mine' | dd of="$1" bs=1 seek=$((size / 2)) conv=notrunc status=none && edited+=("$1") ;;
  esac
}

for kind in sweep map basins gear run crosscheck tolerance; do
  declare -n arguments=$kind
  command=("$epicyclic" "${arguments[@]}" -o "$kind")
  expected=$(code_of "${command[@]}")
  [ "$expected" -le 1 ] || fail "$kind: $(<stderr)"
  cp -r "$kind" "$kind.whole"
  mapfile -t files < <(cd "$kind" && find . -type f ! -name run.json ! -name .lock ! -name 'journal*' | sort)
  for round in 0 1 2 3; do
    edited=()
    for k in "${!files[@]}"; do damage "$kind/${files[k]}" $((k + round)); done
    code=$(code_of "${command[@]}")
    [ "$code" = "$expected" ] || fail "$kind, round $round: exit code $code: $(<stderr)"
    grep -q 'all files are written again' stderr || fail "$kind, round $round: not told: $(<stderr)"
    for file in "${edited[@]}"; do
      grep -qa mine "$file.changed" || fail "$kind, round $round: the edited $file is not kept"
      rm -f "$file.changed"
    done
    same_folder "$kind.whole" "$kind"
  done
  # Nothing to do: nothing is done.
  before=$(sha256sum "$kind/run.json")
  code_of "${command[@]}" >/dev/null
  grep -q 'complete already' stderr || fail "$kind: not complete: $(<stderr)"
  [ "$before" = "$(sha256sum "$kind/run.json")" ] || fail "$kind: a complete folder was changed"
  echo "$kind: ${#files[@]} files"
done
same_folder sweep.whole undrawn

# What is no part of the study is nobody's business; a folder of figures may be gone as a whole; an edit is not lost by a second.
echo mine >sweep/notes.txt
rm -r sweep/figures
mkdir sweep/points.csv.changed
echo one >>sweep/points.csv
[ "$(code_of "$epicyclic" "${sweep[@]}" -o sweep)" = 0 ] || fail "without figures: $(<stderr)"
[ "$(cat sweep/notes.txt)" = mine ] || fail "notes were touched"
[ "$(tail -n 1 sweep/points.csv.changed-2)" = one ] || fail "the second edit is not kept"
rm -r sweep/points.csv.changed* sweep/notes.txt
same_folder sweep.whole sweep
# A run.json that leads out of the folder leads nowhere.
echo mine >outside
sed -i 's|"points.csv": {|"../outside": {|' sweep/run.json
[ "$(code_of "$epicyclic" "${sweep[@]}" -o sweep)" = 0 ] || fail "with a name outside: $(<stderr)"
[ "$(cat outside)" = mine ] || fail "a file outside was touched"
same_folder sweep.whole sweep

# A cut journal: the study goes on, and says so.
for kind in sweep crosscheck; do
  declare -n arguments=$kind
  sed -i 's/"state": *"complete"/"state": "running"/' $kind/run.json
  truncate -s -100 $kind/journal.bin
  code_of "$epicyclic" "${arguments[@]}" -o $kind >/dev/null
  grep -q 'journal.bin: removed the last [0-9]* bytes' stderr || fail "$kind: a cut tail is not told: $(<stderr)"
  same_folder $kind.whole $kind
done
finish
