#!/usr/bin/env bash
# reading.sh EPICYCLIC SOURCE_DIR
#
# The Python package reads results of each kind: the same numbers as the CSV files have. The examples of
# docs/howto/use_from_python.md run. Skipped (77) without a Python that has h5py, pandas, xarray, h5netcdf and matplotlib.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"
source "$here/results.bash"
source_dir=$2

# Debian's packages belong to its own Python, which need not be the first one.
for python in "${EPICYCLIC_PYTHON:-python3}" /usr/bin/python3 none; do
  "$python" -c 'import h5py, h5netcdf, matplotlib, pandas, xarray' 2>/dev/null && break
done
[ "$python" != none ] || skip "no Python with h5py, h5netcdf, matplotlib, pandas and xarray"
export PYTHONPATH=$source_dir/app/python MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
without_drawing
make_results

EPICYCLIC_RESULTS=$work/out "$python" -W error::DeprecationWarning:epicyclic -m unittest discover -s "$source_dir/tests/python" -p '*_test.py' 2>log ||
  fail "$(<log)"
tail -n 3 log

blocks_of "$source_dir/docs/howto/use_from_python.md" python >example.py
[ "$(grep -c . example.py)" -ge 10 ] || fail "the page has no example"
"$python" example.py >log 2>&1 || fail "the examples of the page: $(tail -n 5 log)"
finish
