#!/usr/bin/env bash
# docs.sh EPICYCLIC SOURCE_DIR
#
# What README.md and docs/ tell readers to type, works: each `app/run ...` of a table and of a block marked sh, with the
# files of blocks that stand behind "<!-- file: NAME -->". Studies are cut to a few points and periods, and drawn once for
# each command; that each key is known, each file there and each command ends with 0 stays true. Links and pictures of the
# pages lead to files. Blocks marked bash are those of the tutorials, whose commands need each other: tutorials.sh.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source_dir=$2

pages=("$source_dir/README.md" "$source_dir"/docs/*.md "$source_dir"/docs/*/*.md)
[ ${#pages[@]} -gt 20 ] || fail "docs/ is missing"
cp -r "$inputs" inputs

# Files that the pages give, under the names that they give them.
for page in "${pages[@]}"; do
  awk '/^<!-- file: .* -->$/ { name = $3 } name != "" && /^```/ { inside = !inside; if (!inside) { close(name); name = "" }; next }
       inside && name != "" { print > name }' "$page"
done

# Commands, one a line: of blocks marked sh, and of tables.
for page in "${pages[@]}"; do
  awk '/^```/ { inside = $0 == "```sh"; next } inside && !/^(#|$)/' "$page" |
    sed -e :more -e '/\\$/ { N; s/\\\n *//; b more' -e '}'
  grep -oE '^\|.*' "$page" | grep -oE '`app/run [^`]*`' | tr -d '`' || true
done | sort -u >commands
[ "$(wc -l <commands)" -ge 20 ] || fail "only $(wc -l <commands) commands were found: $(cat commands)"

few=(--set /study/transient_periods=2 --set /study/recorded_periods=4 --set /study/classification_periods=0)
told=("${few[@]:0:4}" --set /study/classification_periods=8)  # where chaos is asked for
plane=(--set /study/first/points=2 --set /study/second/points=2)
# A name's sweeps are cut where all of them are.
claims=(--set /study/sweeps/0/points=5 --set /study/sweeps/1/points=2)
glance=(--set /study/screening/transient_periods=2 --set /study/screening/recorded_periods=4 --set /study/sweeps/0/survey_points=5 --set /study/sweeps/1/survey_points=2)
declare -A cut=(
  [sweep]="--set /study/points=3 ${few[*]}"
  [reproduce]="${claims[*]} ${told[*]}"
  [calibrate]="${claims[*]} ${told[*]} ${glance[*]} --set /study/search/candidates=16 --set /study/search/refinement=0 --set /study/search/profile=0"
  [robustness]="${glance[*]} --set /study/survey/draws=2 --set /study/survey/screening/transient_periods=2 --set /study/survey/screening/recorded_periods=4"
  [map]="${plane[*]} ${few[*]}"
  [basins]="${plane[*]} ${few[*]} --set /study/transient=fixed"
  [continue]="--set /study/period_max=1 --set /study/orbits=2 --set /study/branches=1 --set /study/transient_periods=40 --set /study/tolerance=1e-7"
  [run]="--set /study/transient=fixed --set /study/transient_periods=2 --set /study/recorded_periods=16 --set /study/exponent_periods=12 --set /study/spectrum_periods=16 --set /study/history_periods=2 --set /study/check_tolerance=1e-6"
  [tolerance]="--set /study/points=1 --set /study/from=2.8 --set /study/transient_periods=20 --set /study/recorded_periods=16 --set /study/tolerances=[1e-5,1e-6] --set /study/methods=[\"arkode-dopri5\"] --set /study/chaotic_periods=64"
  [crosscheck]="--set /study/points=1 --set /study/from=2.8 --set /study/to=2.8 --set /study/transient_periods=20 --set /study/recorded_periods=16 --set /study/methods=[\"arkode-dopri5\",\"cvode-adams\"]"
)
count=0
without_drawing
declare -A drawn
while IFS= read -r line; do
  eval "words=($line)"  # as a shell takes it: quotes are part of what is typed
  [ "${words[0]}" = app/run ] || { fail "not a command of ours: $line"; continue; }
  count=$((count + 1))
  command=${words[1]:-}
  case $line in *" reproduce "* | *" calibrate "* | *" robustness "* | *claims.json*) has_claims || continue ;; esac
  read -r -a more <<<"${cut[$command]:-}"
  arguments=("${words[@]:1}" "${more[@]}")
  # What is said of its time is measured, for seconds by each thread. Stages have no periods.
  if [ "$command" = check ]; then
    arguments+=(--threads 1)
    ! grep -q '"study"' "${words[2]}" || arguments+=("${told[@]}")
  fi
  # Claims that have a name have more sweeps.
  if [ "$command ${words[2]:-}" = "reproduce tang2020" ]; then
    k=0
    for points in 67 19 19 11 21 11 4 11 4 23 23; do arguments+=(--set "/study/sweeps/$((k++))/points=$points"); done
    arguments+=(--set '/study/starts=["cold"]' --set /study/recorded_periods=16)
  fi
  # Each in a folder of its own, whatever the page calls it.
  for ((k = 0; k < ${#arguments[@]}; ++k)); do
    [ "${arguments[k]}" != -o ] || arguments[k + 1]=out$count
  done
  path=$PATH
  [ -n "${drawn[$command]:-}" ] && [ "$command" != plot ] || path=$with_gnuplot
  drawn[$command]=yes
  code=$(PATH=$path code_of "$epicyclic" "${arguments[@]}")
  [ "$code" = 0 ] || fail "$line: exit $code: $(tail -n 3 stderr)"
done <commands
echo "$count commands"

# What the pages point at is there.
for page in "${pages[@]}"; do
  while IFS= read -r target; do
    target=${target%%#*}
    case $target in '' | http*) continue ;; esac
    [ -e "$(dirname "$page")/$target" ] || fail "${page#"$source_dir"/} points at $target, which is not there"
  done < <(grep -oE '\]\([^)]*\)' "$page" | sed 's/^](//; s/)$//')
done
# Each file, function and key that the table of equations names exists. `x*` is any that begins so.
while IFS= read -r name; do
  case $name in
    /*) grep -rqwF --include='*.[hc]pp' -- "\"${name##*/}\"" "$source_dir/lib" || fail "EQUATIONS.md names the key $name, which the input does not have" ;;
    */*)
      file=${name#tests/}
      compgen -G "$source_dir/lib/$name" >/dev/null || compgen -G "$source_dir/tests/$file" >/dev/null ||
        compgen -G "$source_dir/lib/*/$name" >/dev/null || fail "EQUATIONS.md names $name, which is no file"
      ;;
    *.cpp) compgen -G "$source_dir/tests/*/$name" >/dev/null || fail "EQUATIONS.md names the test $name, which is not there" ;;
    *)
      case $name in _* | ...*) continue ;; esac  # ends of names
      grep -rqwF --include='*.[hc]pp' --include='*.inc' -- "${name%%[(*]*}" "$source_dir/lib" "$source_dir/app" ||
        fail "EQUATIONS.md names $name, which is nowhere in the code"
      ;;
  esac
done < <(grep -v '^    ' "$source_dir/lib/EQUATIONS.md" | grep -oE '`[A-Za-z_0-9./*()]+`' | tr -d '`' | sort -u)
finish
