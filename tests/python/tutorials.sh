#!/usr/bin/env bash
# tutorials.sh EPICYCLIC SOURCE_DIR PACKAGE_DIR
#
# The tutorials that compute in Python run from their beginning to their end, and have the results that they state. Skipped
# (77) without a Python that loads the module and has pandas, h5py and matplotlib. Without dask.distributed the map is left
# out.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"
source_dir=$2

export PYTHONPATH=$3${PYTHONPATH:+:$PYTHONPATH} MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
for python in "${EPICYCLIC_PYTHON:-python3}" /usr/bin/python3 none; do
  "$python" -c 'import h5py, matplotlib, pandas, epicyclic._core' 2>/dev/null && break
done
[ "$python" != none ] || skip "no Python with h5py, matplotlib, pandas and the module"
without_drawing
ln -s "$inputs" inputs

run() {
  local page=$source_dir/docs/tutorials/$1
  "$python" -W ignore "$here/run_page.py" "${page}.md" >log 2>&1 || fail "$1: $(tail -n 15 log)"
  tail -n 1 log
}

run drawing_in_python <<'END'
assert list(table.regime[[0, 2, 3]]) == ["chaotic"] * 3 and list(table.period[4:]) == [2, 2, 2, 1]
assert list(table.kv_rp.round(2)) == [6.18, 6.07, 5.32, 4.02, 3.48, 3.39, 3.23, 2.95]
assert list(table.loss_time_rp_1.round(3)) == [0.588, 0.567, 0.571, 0.560, 0.508, 0.461, 0.398, 0.359]
assert set(other.points.regime) == {"periodic"} and round(other.points.kv_rp.max(), 2) == 2.47
assert mesh["error_amplitude_um"] == 4.75 and run.points.value[0] == point.value
assert len(axes.get_legend().get_texts()) >= 3
END
run question_in_python <<'END'
assert list(sweep.points.regime) == ["quasiperiodic"] * 2 + ["periodic"] * 6
assert all(abs(sweep.points.lyapunov_max[:2]) < sweep.points.lyapunov_max_error[:2])
assert list(branches.special.kind) == ["flip", "neimark_sacker"]
assert list(branches.special.value.round(6)) == [2.148946, 2.068968]
assert set(branches.table("proof").cause) == {"bifurcation"}
END
if "$python" -c 'import distributed' 2>/dev/null; then
  run map_on_a_cluster <<'END'
counts = result.points.regime.value_counts()
assert (counts["periodic"], counts["chaotic"], counts["quasiperiodic"]) == (14, 8, 2)
assert [(row["regime"], row["period"]) for row in rows] == [("periodic", 2), ("periodic", 1)]
assert plane.check()["points"] == 225 and plane.check()["mesh_periods"] == 59400
END
else
  echo "map_on_a_cluster is left out: no dask.distributed"
fi
finish
