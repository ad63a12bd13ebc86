#!/usr/bin/env bash
# check_kernel_symbols.sh ARCHIVE...
#
# An object file compiled for an instruction set of its own may define symbols in that set's namespace only. An inline
# function outside it has the same name in the baseline's object files, and the linker keeps one of them: on a machine
# without the instruction set the program would die. Object files are told by their names: *_avx2.cpp, *_avx512.cpp,
# and *_again.cpp for copies.
set -euo pipefail

looked_at=0
offences=0
for archive in "$@"; do
  while read -r object set; do
    looked_at=$((looked_at + 1))
    # W, V, u: one of several definitions is kept. Upper case otherwise: another object file can call it.
    while read -r _ kind name; do
      [[ $name == __odr_asan.* ]] && continue  # AddressSanitizer's, one for each variable that is looked at here too
      case $kind in
        [A-TX-Z]) [[ $name == *"::$set::"* ]] && continue ;;
        [WVvwu]) [[ $name == *"::$set::"* ]] && continue ;;
        *) continue ;;
      esac
      echo "$object: $kind $name"
      offences=$((offences + 1))
    done < <(nm -C --defined-only "$archive" 2>/dev/null | awk -v o="$object:" '/\.o:$/ { on = $0 == o; next } on && NF > 2')
  done < <(ar t "$archive" | sed -nE 's/^(.*_(avx[0-9]+(_again)?)\.cpp\.o)$/\1 \2/p')
done
if [ "$looked_at" = 0 ]; then
  echo "no object file of an instruction set in $*"
  exit 1
fi
[ "$offences" = 0 ]
