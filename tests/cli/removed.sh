#!/usr/bin/env bash
# removed.sh EPICYCLIC SOURCE_DIR
#
# A folder that is removed, moved or replaced while a study of hours runs in it: exit 5 within a minute, in the midst of a long
# point too, and said why; what is moved goes on where it is; what stands in the folder's place is not touched.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

sweep=(sweep "${speeds[@]}" --set /study/points=2 --set /study/transient_periods=100000 --threads 1)
# One mesh period of it takes minutes.
point=(sweep "${speeds[@]}" --set /study/points=2 --set /study/from=1e-5 --set /study/to=2e-5
  --set /integrator/relative_tolerance=1e-13 --set /integrator/max_steps_per_period=1000000000 --threads 2)
run=(run "$inputs/tang2020_run.json" --set /study/transient_periods=100000)
studies=(sweep point run)
launch=()
if "$epicyclic" --version | grep -q '^MPI ' && command -v mpirun >/dev/null; then
  ranks=("${sweep[@]}")
  studies+=(ranks)
  launch=("${of_mpi[@]}" mpirun --oversubscribe -n 2)
  [ "$(id -u)" != 0 ] || launch+=(--allow-run-as-root)
fi

for study in "${studies[@]}"; do
  declare -n arguments=$study
  for how in removed moved replaced; do
    rm -rf folder elsewhere
    start=()
    [ $study != ranks ] || start=("${launch[@]}")
    timeout -s KILL 90 "${start[@]}" "$epicyclic" "${arguments[@]}" -o folder >stdout 2>stderr </dev/null &
    pid=$!
    until grep -qs '"started"' folder/run.json || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
    sleep 0.5
    case $how in
      removed) rm -rf folder ;;
      moved) mv folder elsewhere ;;
      replaced) rm -rf folder && mkdir folder && echo mine >folder/thesis.txt ;;
    esac
    code=0
    wait $pid || code=$?
    [ "$code" = 5 ] || fail "$study, $how: exit code $code: $(<stderr)"
    grep -q 'the folder was removed or moved while the study ran' stderr || fail "$study, $how: not told: $(<stderr)"
    case $how in
      removed) [ ! -e folder ] || fail "$study: the folder is there again: $(ls -A folder)" ;;
      moved) [ -s elsewhere/run.json ] || fail "$study: what was moved is not whole" ;;
      replaced) [ "$(ls -A folder)" = thesis.txt ] || fail "$study: something was written into another's folder" ;;
    esac
  done
done
finish
