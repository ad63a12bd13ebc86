#!/usr/bin/env bash
# bad_inputs.sh EPICYCLIC SOURCE_DIR
#
# Runs `epicyclic sweep` on each case of tests/input/bad_inputs/cases.txt: exit code 2, the expected words on stderr,
# nothing on stdout, nothing written. Then outputs that cannot be written: exit code 5. The good pair that the cases are
# made from must be accepted.
set -euo pipefail

epicyclic=$1
data=$2/tests/input/bad_inputs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

good_study=$(<"$data/study.json")
good_stage=$(<"$data/stage.json")
failed=0
count=0

fail() {
  echo "$name: $1"
  sed 's/^/    /' "$work/stderr"
  failed=$((failed + 1))
}

begin() {
  name=$1
  folder=$work/$name
  mkdir "$folder"
  input=study.json
  arguments=()
  expected=()
  printf '%s\n' "$good_study" >"$folder/study.json"
  printf '%s\n' "$good_stage" >"$folder/stage.json"
}

# replace FILE "FROM => TO"
replace() {
  local text from to
  text=$(<"$folder/$1")
  from=${2%% => *}
  to=$(printf '%b.' "${2#* => }")
  to=${to%.}
  case $text in
    *"$from"*) printf '%s\n' "${text%%"$from"*}$to${text#*"$from"}" >"$folder/$1" ;;
    *) fail "cases.txt: '$from' does not stand in $1" ;;
  esac
}

cut_behind() {
  local text
  text=$(<"$folder/$1")
  printf '%s' "${text%%"$2"*}$2" >"$folder/$1"
}

finish() {
  local code=0 text
  count=$((count + 1))
  (cd "$folder" && exec "$epicyclic" sweep "$input" -o "$folder/out" "${arguments[@]}") \
    >"$work/stdout" 2>"$work/stderr" </dev/null || code=$?
  [ $code -eq 2 ] || fail "exit code $code, must be 2"
  [ ! -s "$work/stdout" ] || fail "something stands on stdout"
  [ ! -e "$folder/out" ] || fail "the output folder was made"
  for text in "${expected[@]}"; do
    grep -qF -e "$text" "$work/stderr" || fail "stderr lacks: $text"
  done
  rm -rf "$folder"
}

name=
: >"$work/stderr"
while IFS= read -r line; do
  verb=${line%% *}
  rest=${line#"$verb"}
  rest=${rest# }
  case $verb in
    '' | '#'*) ;;
    case)
      [ -z "$name" ] || finish
      begin "$rest"
      ;;
    study | stage) replace "$verb.json" "$rest" ;;
    study_is | stage_is) printf '%b' "$rest" >"$folder/${verb%_is}.json" ;;
    study_cut | stage_cut) cut_behind "${verb%_cut}.json" "$rest" ;;
    input) input=$rest ;;
    set) arguments+=(--set "$rest") ;;
    expect) expected+=("$rest") ;;
    lines) ;; # what the loader tells; the command may say more
    *) fail "cases.txt: unknown verb $verb" ;;
  esac
done <"$data/cases.txt"
finish

# Outputs that cannot be written; root may write anywhere, so by paths that cannot be folders.
begin output
touch "$folder/file"
for out in file file/below /proc/nowhere/out; do
  code=0
  (cd "$folder" && exec "$epicyclic" sweep study.json -o "$out") >"$work/stdout" 2>"$work/stderr" </dev/null || code=$?
  count=$((count + 1))
  name="output $out"
  [ $code -eq 5 ] || fail "exit code $code, must be 5"
  [ ! -s "$work/stdout" ] || fail "something stands on stdout"
  grep -qF -e "$out" "$work/stderr" || fail "stderr does not name $out"
done

# What was probably meant by a command or an option that is not known.
meant() {
  code=0
  name="$*"
  count=$((count + 1))
  "$epicyclic" "${@:2}" >"$work/stdout" 2>"$work/stderr" </dev/null || code=$?
  [ $code -eq 2 ] || fail "exit code $code, must be 2"
  grep -qF -e "$1" "$work/stderr" || fail "not said: $1; but: $(<"$work/stderr")"
}
meant "unknown command 'swep'; did you mean 'sweep'?" swep study.json -o out
meant "unknown command 'contine'; did you mean 'continue'?" contine
meant "unknown command 'xyz'" xyz
meant "unknown option '--thread'; did you mean '--threads'?" sweep study.json -o out --thread 1
meant "unknown option '--outptu'; did you mean '--output'?" gear study.json --outptu=out
meant "unknown option '--versoin'; did you mean '--version'?" --versoin

name="good input"
code=0
(cd "$folder" && exec "$epicyclic" sweep study.json -o out) >"$work/stdout" 2>"$work/stderr" </dev/null || code=$?
[ $code -eq 0 ] || fail "exit code $code, must be 0"

echo "$count bad inputs and outputs, $failed failures"
[ $failed -eq 0 ]
