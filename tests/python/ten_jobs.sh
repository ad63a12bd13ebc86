#!/usr/bin/env bash
# ten_jobs.sh EPICYCLIC SOURCE_DIR PACKAGE_DIR
#
# The blocks of docs/howto/ten_jobs_in_python.md run in their order, have ten lines at most, and give the same numbers with
# the package and without it. Skipped (77) without a Python that loads the module and has what the page imports.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"
source "$here/results.bash"
source_dir=$2

export PYTHONPATH=$3 MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
for python in "${EPICYCLIC_PYTHON:-python3}" /usr/bin/python3 none; do
  "$python" -c 'import h5py, matplotlib, pandas, scipy, epicyclic._core' 2>/dev/null && break
done
[ "$python" != none ] || skip "no Python with h5py, matplotlib, pandas, scipy and the module"
without_drawing

# As in the root folder of the repository, after the tutorial's C file.
ln -s "$inputs" inputs
mkdir app
printf '#!/bin/sh\nexec "%s" "$@"\n' "$epicyclic" >app/run && chmod +x app/run
blocks_of "$source_dir/docs/tutorials/your_own_oscillator.md" c >duffing.c
"${CC:-cc}" -O2 -shared -fPIC -o duffing.so duffing.c -lm

"$python" -W ignore "$here/run_page.py" "$source_dir/docs/howto/ten_jobs_in_python.md" 10 >log 2>&1 <<'END' || fail "$(tail -n 15 log)"
# What the package computed, beside what the command did.
def same_bytes(left, right, names=("points.csv", "poincare.csv")):
    for name in names:
        with open(f"{left}/{name}", "rb") as one, open(f"{right}/{name}", "rb") as other:
            assert one.read() == other.read(), (left, right, name)

same_bytes("out/py/speed", "out/speed")
same_bytes("out/py/map", "out/map", ["points.csv"])
assert np.isclose(point["lyapunov_max"], same.lyapunov_max, rtol=1e-15) and point["regime"] == same.regime
assert len(chaotic) == len(pd.read_csv("out/chaotic.csv")) > 0
left, right = branches.special, special
assert len(right) > 0 and np.allclose(left[["value", "error_bound"]], right[["value", "error_bound"]], rtol=1e-15, atol=0)
assert np.allclose(table.kv_sp, pd.read_csv("out/damping_0.04/points.csv").kv_sp, rtol=1e-15, atol=0)
assert abs(doublings[0] - 0.2655817861) < 1e-8 and abs(doublings[0] - by_scipy) < 1e-8
assert min(abs(value - 0.2866931578) for value in doublings) < 1e-8
assert np.isclose(kv_by_command(best.x), best.fun, rtol=1e-15) and best.fun < kv(7)
END
tail -n 1 log
finish
