#!/usr/bin/env bash
# computing.sh EPICYCLIC SOURCE_DIR PACKAGE_DIR
#
# What the Python package computes, beside the command: computing_checks.py. Skipped (77) without a Python that loads the
# module and has numpy, pandas and h5py.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"
source_dir=$2

export PYTHONPATH=$3 MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
for python in "${EPICYCLIC_PYTHON:-python3}" /usr/bin/python3 none; do
  "$python" -c 'import h5py, pandas, epicyclic._core' 2>/dev/null && break
done
[ "$python" != none ] || skip "no Python with h5py, pandas and the module"
without_drawing
"${CXX:-c++}" -O2 -shared -fPIC -o duffing.so "$here/duffing.cpp"

EPICYCLIC=$epicyclic EPICYCLIC_INPUTS=$inputs EPICYCLIC_DUFFING=$PWD/duffing.so \
  "$python" -W error::DeprecationWarning:epicyclic "$here/computing_checks.py" 2>log || fail "$(<log)"
tail -n 3 log

source "$here/results.bash"
blocks_of "$source_dir/docs/howto/compute_in_python.md" python >example.py
[ "$(grep -c . example.py)" -ge 10 ] || fail "the page has no example"
"$python" -W ignore example.py >log 2>&1 || fail "the examples of the page: $(tail -n 5 log)"

# The tutorial, with few points and the first branch.
tutorial=$source_dir/docs/tutorials/your_own_oscillator.md
blocks_of "$tutorial" c >duffing.c
"${CC:-cc}" -O2 -shared -fPIC -o duffing.so duffing.c -lm
blocks_of "$tutorial" python | sed 's/0.5, 151)/0.5, 3)/; s/transient=200/transient=20/; s/largest_period=4/largest_period=1/' >tutorial.py
if "$python" -c 'import matplotlib' 2>/dev/null; then
  "$python" tutorial.py >log 2>&1 || fail "the tutorial: $(tail -n 5 log)"
  grep -q '^1 flip 0.2655817861 ' log || fail "the tutorial locates another doubling: $(<log)"
fi
finish
