# Completion of epicyclic in bash: the program itself knows what can follow.
_epicyclic() {
  local words word part candidate length
  read -ra words <<<"${COMP_LINE:0:COMP_POINT}"
  [[ ${COMP_LINE:0:COMP_POINT} != *[[:space:]] ]] || words+=('')
  while [[ ${#words[@]} -gt 1 && ${words[0]} != "$1" ]]; do words=("${words[@]:1}"); done
  word=${words[-1]} part=${COMP_WORDS[COMP_CWORD]}
  # Bash splits a word at = and :, and wants the last part of it.
  [[ $part != [=:] ]] || part=
  length=$((${#word} - ${#part}))
  COMPREPLY=()
  while IFS=$'\t' read -r candidate _; do
    candidate=${candidate:length < 0 ? 0 : length}
    [[ $candidate != *[[:space:]\'\"\$\&\;\(\)\<\>\|\*\?\`\\]* ]] || printf -v candidate %q "$candidate"
    COMPREPLY+=("$candidate")
  done < <("$1" __complete "${words[@]:1}" 2>/dev/null)
  [[ ${#COMPREPLY[@]} != 1 || ${COMPREPLY[0]} != *[=:/] ]] || compopt -o nospace 2>/dev/null
}
complete -F _epicyclic epicyclic epicyclic-mpi
