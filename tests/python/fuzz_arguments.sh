#!/usr/bin/env bash
# fuzz_arguments.sh EPICYCLIC SOURCE_DIR PACKAGE_DIR
#
# The package refuses arguments of wrong types, shapes and values: fuzz_arguments.py, CALLS calls from the random numbers of
# SEED. Skipped (77) without a Python that loads the module and has pandas and h5py.
#
# Of a build by the preset asan with EPICYCLIC_PYTHON=ON, AddressSanitizer is loaded before Python, and with it the C++
# library, whose exceptions it watches. Kernels take long to compile there; these options compile them once:
# -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS_DEBUG='-O1 -g1 -fno-omit-frame-pointer'
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"

export PYTHONPATH=$3 MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
runtime=()
for module in "$3"/epicyclic/_core.*.so; do
  ! grep -qa __asan_init "$module" ||
    runtime=(env "LD_PRELOAD=$("${CXX:-c++}" -print-file-name=libasan.so) $("${CXX:-c++}" -print-file-name=libstdc++.so)"
      "ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1")
done
for python in "${EPICYCLIC_PYTHON:-python3}" /usr/bin/python3 none; do
  "${runtime[@]}" "$python" -c 'import h5py, pandas, epicyclic._core' 2>/dev/null && break
done
[ "$python" != none ] || skip "no Python with h5py, pandas and the module"
without_drawing
"${CXX:-c++}" -O2 -shared -fPIC -o duffing.so "$here/duffing.cpp"

EPICYCLIC_INPUTS=$inputs EPICYCLIC_DUFFING=$PWD/duffing.so \
  "${runtime[@]}" "$python" "$here/fuzz_arguments.py" "${CALLS:-2000}" "${SEED:-1}" >log 2>&1 || fail "$(tail -n 60 log)"
tail -n 1 log
finish
