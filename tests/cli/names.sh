#!/usr/bin/env bash
# names.sh EPICYCLIC SOURCE_DIR
#
# A stage file may be called as any file or folder of a finished study: its copy takes nobody's place, the results are the
# same bytes, the second call finds them complete, and the name is told.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

# Pictures take most of the time and none of the names: without gnuplot all else is there, and the code is 1.
mkdir none
quick_code_of() { PATH=$work/none code_of "$@"; }

short='{"kind":"sweep","points":2,"transient_periods":0,"recorded_periods":2,"period_max":1,"classification_periods":0}'
one='{"kind":"run","transient_periods":0,"recorded_periods":2,"period_max":1,"classification_periods":0,"exponent_periods":0,
  "history_periods":2,"shown_periods":1,"spectrum_periods":2,"dense_phases":16}'

# $1: command, $2: stage's name, $3: its plan; writes the study beside the stage.
study_of() {
  mkdir -p "of/$2"
  cp "$inputs/tang2020.json" "of/$2/$2"
  printf '{"stage":"%s","study":%s}' "$2" "$3" >"of/$2/study.json"
  [ "$(quick_code_of "$epicyclic" "$1" "of/$2/study.json" -o "$1/$2")" = 1 ] || fail "$1 of a stage called $2: $(<stderr)"
}

# The bytes of all results: not of what holds facts of the session, nor of the study as written.
results() {
  (cd "$1" && find . -type f ! -name run.json ! -name .lock ! -name input.json -print0 | sort -z | xargs -0 sha256sum)
}

declare -A tried
for command in sweep run gear; do
  plan=$short
  [ "$command" != run ] || plan=$one
  study_of $command plain.json "$plan"
  results $command/plain.json >expected
  names=(journal.rank-1.bin .run.json.1.1.tmp)
  while IFS= read -r name; do names+=("$name"); done < <(ls -A $command/plain.json)
  [ ${#names[@]} -gt 8 ] || fail "$command left few files: ${names[*]}"
  for name in "${names[@]}"; do
    # A command has names of its own; those of all do the same in each.
    [ -z "${tried[$name]:-}" ] || continue
    tried[$name]=1
    study_of $command "$name" "$plan"
    results "$command/$name" | diff expected - >differences || fail "$command of a stage called $name: $(<differences)"
    cmp -s "$inputs/tang2020.json" "$command/$name/input.stage.json" || fail "$command: the copy of $name is another file"
    grep -qF "\"input.stage.json\": \"$name\"" "$command/$name/run.json" || fail "$command: run.json does not tell $name"
    grep -qF '"input.json": "study.json"' "$command/$name/run.json" || fail "$command: run.json does not tell the study's name"
    [ "$(quick_code_of "$epicyclic" $command "of/$name/study.json" -o "$command/$name")" = 1 ] ||
      fail "$command once more, of a stage called $name: $(<stderr)"
    grep -q 'complete already' stderr || fail "$command once more, of a stage called $name: $(<stderr)"
  done
done

# A name that is no UTF-8 is told as well as it can be.
cp "$inputs/tang2020.json" $'of/\xff.json'
[ "$(quick_code_of "$epicyclic" gear $'of/\xff.json' -o gear/bytes)" = 1 ] || fail "a name of bytes: $(<stderr)"

finish
