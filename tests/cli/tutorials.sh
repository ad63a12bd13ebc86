#!/usr/bin/env bash
# tutorials.sh EPICYCLIC SOURCE_DIR
#
# Each tutorial can be typed from its beginning to its end: the commands of its blocks marked bash, in their order and in
# one folder, each with the exit code that its page states. Studies are cut to a few points and periods.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source_dir=$2
tutorials=("$source_dir"/docs/tutorials/*.md)
[ -e "${tutorials[0]}" ] || fail "docs/tutorials/ is missing"

few=(--set /study/transient_periods=2 --set /study/recorded_periods=4 --set /study/classification_periods=8)
declare -A cut=(
  [sweep]="--set /study/points=3 --set /study/transient=fixed ${few[*]} --set /study/crosscheck/points=0"
  [run]="--set /study/transient=fixed ${few[*]} --set /study/exponent_periods=2 --set /study/spectrum_periods=4 --set /study/history_periods=2 --set /study/check_tolerance=1e-6"
  [crosscheck]="--set /study/transient_periods=20 --set /study/recorded_periods=16 --set /study/methods=[\"arkode-dopri5\"]"
  [tolerance]="--set /study/transient_periods=20 --set /study/recorded_periods=16 --set /study/tolerances=[1e-5,1e-6] --set /study/methods=[\"arkode-dopri5\"] --set /study/chaotic_periods=64"
  [continue]="--set /study/period_max=1 --set /study/orbits=2 --set /study/branches=1 --set /study/transient_periods=40 --set /study/tolerance=1e-7"
  [check]=--no-time
)
# Of claims that have a name.
claims=(--set '/study/starts=["cold"]' --set /study/transient_periods=2 --set /study/recorded_periods=16 --set /study/classification_periods=8)
k=0
for points in 67 19 19 11 21 11 4 11 4 23 23; do claims+=(--set "/study/sweeps/$((k++))/points=$points"); done

without_drawing
total=0
for tutorial in "${tutorials[@]}"; do
  name=${tutorial##*/}
  mkdir "${name%.md}"
  cp -r "$inputs" "$source_dir/validation" "${name%.md}"
  awk '/^```/ { inside = $0 == "```bash"; next } inside' "$tutorial" | sed -e :more -e '/\\$/ { N; s/\\\n *//; b more' -e '}' >lines
  while IFS= read -r line; do
    # Of so few points there is a second one.
    eval "words=($(sed -E 's/(--from [^ ]*:)[0-9]+( |$)/\11\2/' <<<"$line"))"
    [ "${words[0]}" = app/run ] || { fail "$name: not a command of ours: $line"; continue; }
    total=$((total + 1))
    read -r -a more <<<"${cut[${words[1]}]:-}"
    [ "${words[1]}" != reproduce ] || has_claims || continue
    [ "${words[1]}" != reproduce ] || more=("${claims[@]}")
    code=$(cd "${name%.md}" && code_of "$epicyclic" "${words[@]:1}" "${more[@]}")
    case $code:${words[1]}:$line in
      0:*) ;;
      # Three points do not make the diagram that the page explains, nor two orbits the branches.
      1:continue:*--against*) grep -q unexplained "${name%.md}/stdout" || fail "$name: $line: $(tail -n 3 "${name%.md}/stderr")" ;;
      1:crosscheck:* | 1:tolerance:*) [ -s "${name%.md}/stdout" ] || fail "$name: $line: $(tail -n 3 "${name%.md}/stderr")" ;;
      *) fail "$name: $line: exit $code: $(tail -n 3 "${name%.md}/stderr")" ;;
    esac
  done <lines
done
[ "$total" -ge 12 ] || fail "only $total commands were found"
echo "$total commands"
finish
