#!/usr/bin/env bash
# installed.sh EPICYCLIC SOURCE_DIR
#
# Inputs by name from any folder, with the results of the file; completion by the program and by bash; man pages and
# examples of each command; doctor.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source_dir=$2
without_drawing
few=(--set /study/points=2 --set /study/crosscheck/points=0 --set /study/transient_periods=2 --set /study/recorded_periods=4
  --set /study/classification_periods=0)

# A name, with or without .json, is that of an installed input, and the results are the same bytes.
[ "$(code_of "$epicyclic" sweep tang2020_speed "${few[@]}")" = 0 ] || fail "an input by name: $(<stderr)"
grep -qF "input: $inputs/tang2020_speed.json" stderr || fail "the file taken is not named: $(<stderr)"
[ "$(code_of "$epicyclic" sweep "$inputs/tang2020_speed.json" -o by_file "${few[@]}")" = 0 ] || fail "by file: $(<stderr)"
same_results out/tang2020_speed by_file
cp "$inputs"/tang2020{,_speed}.json .
[ "$(code_of "$epicyclic" sweep tang2020_speed.json "${few[@]}")" = 2 ] || fail "a local file is not taken first"
grep -q -- '--output is required' stderr || fail "no folder: $(<stderr)"
[ "$(code_of "$epicyclic" sweep tang2020_speed.json -o by_file "${few[@]}")" = 0 ] || fail "another place: $(<stderr)"
grep -q 'complete already' stderr || fail "the identity depends on the place: $(<stderr)"
rm tang2020*.json
[ "$(code_of "$epicyclic" check tang2020_speed.json --no-time)" = 0 ] || fail "a name with .json: $(<stderr)"
mkdir tang2020_map
[ "$(code_of "$epicyclic" check tang2020_map --no-time)" = 2 ] || fail "a local folder is not taken first"
[ "$(code_of "$epicyclic" sweep tang2020_sped -o none)" = 2 ] || fail "an unknown name"
grep -q "did you mean 'tang2020_speed'" stderr || fail "no near name: $(<stderr)"
[ "$("$epicyclic" inputs | wc -l)" = "$(ls "$inputs"/*.json | wc -l)" ] || fail "inputs lists others"

# What can follow: commands, options, names of options, inputs, keys, points, columns.
follows() {
  local expected=$1
  shift
  "$epicyclic" __complete "$@" >candidates 2>words || fail "__complete $*: exit $?"
  [ ! -s words ] || fail "__complete $* says: $(<words)"
  cut -f 1 candidates | grep -qxF -- "$expected" || fail "__complete $* has no $expected: $(head -n 3 candidates)"
}
follows sweep sw
follows --threads sweep --th
follows pdf plot out --format ''
follows --format=pdf plot out --format=
follows tang2020_map check tang2020_m
follows out/ sweep o
follows tang2020 reproduce tang
follows /stage/lumped/ sweep x --set /stage/lum
follows /study/points= sweep x --set /study/po
follows /study/start=cold sweep x --set /study/start=
follows out/tang2020_speed: run --from out/
follows out/tang2020_speed:up= run --from out/tang2020_speed:
follows out/tang2020_speed:down=0.2 run --from out/tang2020_speed:down=
follows out/tang2020_speed:3 run --from out/tang2020_speed:3
follows kv_sp plot out/tang2020_speed --quantity kv
follows doctor help doc
# Never loud, whatever stands there.
cp out/tang2020_speed/points.csv out/saved.csv
printf '\0\n,,,\n"' >out/tang2020_speed/points.csv
for words in '' 'nothing x' 'sweep --nothing' '--set' 'run --from out/tang2020_speed:up=' 'run --from /nowhere/x' \
  'plot /dev/null --quantity' 'sweep x --set /////=' "help $(printf '\xff')"; do
  read -r -a list <<<"$words"
  "$epicyclic" __complete "${list[@]}" '' >candidates 2>words || fail "__complete $words: exit $?"
  [ ! -s words ] || fail "__complete $words says: $(<words)"
done
rm by_file/points.csv && mkfifo by_file/points.csv
timeout 5 "$epicyclic" __complete run --from by_file:up= >candidates || fail "__complete waits for a pipe"
rm by_file/points.csv && cp out/saved.csv by_file/points.csv
"$epicyclic" __complete >&- 2>words || fail "__complete without stdout: exit $?"

# Bash splits words at = and :, and gets the rest of them.
completed() {
  PATH=$(dirname "$epicyclic"):$PATH bash -c '
    source "$1"
    COMP_LINE=$2 COMP_POINT=${#2} COMP_WORDS=($3) COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _epicyclic epicyclic
    printf "%s\n" "${COMPREPLY[@]}"' bash "$source_dir/app/packaging/completion/epicyclic.bash" "$1" "${2:-$1}"
}
completed 'epicyclic swe' | grep -qx sweep || fail "bash: a command"
completed 'epicyclic sweep x --set /study/start=co' 'epicyclic sweep x --set /study/start = co' | grep -qx cold ||
  fail "bash: behind ="
completed 'epicyclic run --from by_file:up=' 'epicyclic run --from by_file : up =' | grep -qx 0.2 || fail "bash: a point"
mkdir -p 'a folder'
completed 'epicyclic plot a' | grep -qxF 'a\ folder/' || fail "bash: a blank"
for shell in zsh fish; do
  ! command -v $shell >/dev/null || $shell -n "$source_dir"/app/packaging/completion/*epicyclic$([ $shell = zsh ] || echo .fish) ||
    fail "$shell: syntax"
done

# Each command has a man page and an example whose words are its own.
mkdir man
"$epicyclic" __man man
while IFS= read -r command; do
  page=man/epicyclic-$command.1
  [ -s "$page" ] || fail "no man page of $command"
  ! command -v man >/dev/null || [ -z "$(man --warnings -l -Tutf8 -Z "$page" 2>&1 >/dev/null)" ] || fail "$page: warnings"
  [ "$("$epicyclic" help "$command")" = "$("$epicyclic" "$command" --help)" ] || fail "help $command"
  "$epicyclic" help "$command" | sed -n '/^Examples:/,$p' | grep '^  epicyclic' >examples || fail "$command: no example"
  ! grep -v "^  epicyclic $command" examples || fail "$command: an example of another command"
  for option in $(grep -oE -- ' --[a-z-]+' examples | sort -u); do
    "$epicyclic" help "$command" | grep -qE -- "^  .*$option( |$)" || fail "$command: the example's $option"
  done
  for key in $(grep -oE -- '--set [^= ]+' examples | cut -d ' ' -f 2); do
    "$epicyclic" keys "${key#/stage}" >/dev/null 2>&1 || fail "$command: the example's $key"
  done
done < <("$epicyclic" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]\+\) .*/\1/p')
[ "$(ls man | wc -l)" -ge 22 ] || fail "few man pages"
[ "$(code_of "$epicyclic" help swep)" = 2 ] || fail "help of an unknown command"

[ "$(code_of "$epicyclic" doctor)" = 0 ] || fail "doctor: $(<stdout)"
for what in folder machine gnuplot fonts MPI browser Python studies; do
  grep -qE "^$what +(ok|missing) " stdout || fail "doctor does not speak of $what"
done
finish
