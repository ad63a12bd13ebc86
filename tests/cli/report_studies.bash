# Sourced by cli/report.sh and browser/report.sh, behind common.bash: small studies of all kinds that a report draws.

few=(--set /study/transient_periods=40 --set /study/recorded_periods=16 --set /study/classification_periods=256)
coarse=(--set /integrator/relative_tolerance=1e-6)
hostile_name='<img src=x onerror="window.hurt=1"></script><script>window.hurt=1</script> & "a" <b>'

study() {
  "$epicyclic" "$@" >/dev/null 2>stderr </dev/null || fail "$*: $(<stderr)"
}

make_sweep() {
  study sweep "$inputs/tang2020_speed_fixed_ring.json" -o "$1" --set /study/from=2.1 --set /study/to=2.3 --set /study/points=9 "${coarse[@]}" "${few[@]}" "${@:2}"
}

# A folder as a killed process leaves it: some points in its journal, no table.
make_unfinished() {
  cp -r sweep unfinished
  rm -r unfinished/figures unfinished/*.csv unfinished/results.h5 unfinished/sweep.md
  sed -i 's/"state": "complete"/"state": "running"/' unfinished/run.json
}

make_studies() {
  make_sweep sweep
  make_unfinished
  make_sweep hostile --set "/name=$(printf '%s' "$hostile_name" | sed 's/\\/\\\\/g; s/"/\\"/g; s/^/"/; s/$/"/')" --set /study/points=3
  study map "$inputs/tang2020_map.json" -o map --set '/study/directions=["up", "down"]' --set /study/first/points=3 --set /study/second/points=2 "${few[@]}"
  study basins "$inputs/tang2020_basins.json" -o basins --set /study/first/points=3 --set /study/second/points=3
  study gear "$inputs/tang2020.json" -o gear
  study run "$inputs/tang2020_run.json" -o run --set /study/transient=fixed "${few[@]}" --set /study/exponent_periods=0 \
    --set /study/spectrum_periods=64 --set /study/history_periods=2
  study continue "$inputs/tang2020_branches_fixed_ring.json" -o branches --set /study/from=2.1 --set /study/to=2.3 --set '/study/starts=[2.25]' \
    --set /study/largest_period=1 --set /study/tolerance=1e-8 --set /study/branch_points=false
}
