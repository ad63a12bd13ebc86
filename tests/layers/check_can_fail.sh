#!/usr/bin/env bash
# Shows that check_includes.sh can fail: in a scratch tree, each pair (layer, included layer) is tried, and the verdicts
# are compared with the table below, written out once more by hand. Then the ways around the check.
set -euo pipefail

check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_includes.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/lib/{core,gear,model,integrate,analysis,studies,figures,store,input,reports,kinds,claims} "$tree/app/command/claims" "$tree/app/binding" \
  "$tree/lib/integrate/sundials"

failures=0
# expect VERDICT LAYER LINE [FOLDER]: the check of LAYER says VERDICT (0 clean, 1 offence) when one of its files, in this
# folder of its own, has LINE.
expect() {
  local verdict=0 folder=$tree/lib/$2
  [ "$2" != app ] || folder=$tree/app
  folder=$folder/${4:-}
  printf '#pragma once\n%s\n' "$3" >"$folder/scratch.hpp"
  bash "$check" "$tree" "$2" >"$tree/said" 2>&1 || verdict=$?
  if [ "$verdict" != "$1" ] || { [ "$1" = 1 ] && ! grep -qF 'scratch.hpp:2:' "$tree/said"; }; then
    echo "$2 with '$3': expected $1, got $verdict: $(cat "$tree/said")"
    failures=$((failures + 1))
  fi
  rm "$folder/scratch.hpp"
}

columns=(core gear model integrate analysis studies figures store input reports kinds claims)
while read -r layer verdicts; do
  read -r -a verdicts <<<"$verdicts"
  for i in "${!columns[@]}"; do
    expect "${verdicts[i]}" "$layer" "#include \"${columns[i]}/x.hpp\""
    expect "${verdicts[i]}" "$layer" "#include <epicyclic/${columns[i]}/x.hpp>"
  done
done <<'TABLE'
core      0 1 1 1 1 1 1 1 1 1 1 1
gear      0 0 1 1 1 1 1 1 1 1 1 1
model     0 0 0 1 1 1 1 1 1 1 1 1
integrate 0 1 1 0 1 1 1 1 1 1 1 1
analysis  0 1 1 0 0 1 1 1 1 1 1 1
studies   0 0 0 0 0 0 1 1 1 1 1 1
figures   0 1 1 1 1 1 0 1 1 1 1 1
store     0 0 0 0 0 0 1 0 1 1 1 1
input     0 0 0 0 0 0 1 1 0 1 1 1
reports   0 0 0 0 0 0 0 0 0 0 1 1
kinds     0 0 0 0 0 0 0 0 0 0 0 1
claims    0 0 0 0 0 0 0 0 0 0 0 0
app       0 1 1 1 1 0 0 0 0 0 0 1
TABLE

for layer in core gear model integrate analysis studies figures store input reports kinds claims app; do
  expect 1 "$layer" '#include <arkode/arkode_erkstep.h>'
  expect 1 "$layer" '#include <sunmatrix/sunmatrix_dense.h>'
done
expect 0 integrate '#include <arkode/arkode_erkstep.h>' sundials
expect 0 integrate '#include <nvector/nvector_serial.h>' sundials

expect 0 app '#include "claims/x.hpp"' command/claims
expect 0 app '#include "analysis/x.hpp"' binding
expect 1 app '#include "claims/x.hpp"' binding

expect 1 core '  #  include   "store/x.hpp"'
expect 1 core '#include "../store/x.hpp"'
expect 1 core '#include "core/../store/x.hpp"'
expect 1 core '#include "elsewhere/x.hpp"'
expect 1 gear '#include <model/x.hpp> // "core/x.hpp"'
expect 0 core '#include "x.hpp"'
expect 0 core '#include <vector>'
expect 0 core '#include <Eigen/Dense>'
expect 0 core '#include <sys/stat.h>'
expect 0 core '// #include "store/x.hpp"'

if [ $failures -gt 0 ]; then
  echo "$failures wrong verdicts"
  exit 1
fi
