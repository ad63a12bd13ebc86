# Sourced after cli/common.bash by what reads results in Python and Octave: small studies of each kind, in out/.

make_results() {
  local few=(--set /study/transient_periods=2 --set /study/recorded_periods=8 --set /study/classification_periods=0)
  local plane=(--set /study/first/points=3 --set /study/second/points=2 --set /study/transient=fixed)
  local rough=(--set /study/transient_periods=20 --set /study/recorded_periods=16 --set /study/points=1
    --set /study/from=2.8 --set '/study/methods=["arkode-dopri5","cvode-adams"]')
  local study code
  local -A arguments=(
    [speed]="sweep tang2020_speed.json --set /study/points=4 --set /study/crosscheck/points=0 ${few[*]}"
    [rpm]="sweep tang2020_speed.json --set /study/points=3 --set /study/crosscheck/points=0 --set /study/parameter=sun_speed_rpm --set /study/from=4000 --set /study/to=30000 ${few[*]}"
    [map]="map tang2020_map.json --set /study/directions=[\"up\",\"down\"] ${plane[*]} ${few[*]}"
    [basins]="basins tang2020_basins.json ${plane[*]} ${few[*]}"
    [run]="run tang2020_run.json --set /operation/mesh_frequency_ratio=2.8 --set /study/recorded_periods=16 --set /study/exponent_periods=12 --set /study/check_tolerance=1e-6 --set /study/spectrum_periods=16 --set /study/history_periods=2"
    [branches]="continue tang2020_loci.json --set /study/branches=2 --set /study/orbits=60 --set /study/transient_periods=40 --set /study/tolerance=1e-8 --set /study/from=2.12 --set /study/to=2.18 --set /study/starts=[2.17] --set /study/loci/from=0.048 --set /study/loci/to=0.052"
    [tolerance]="tolerance tang2020_tolerance.json ${rough[*]} --set /study/tolerances=[1e-5,1e-6] --set /study/chaotic_periods=64"
    [crosscheck]="crosscheck tang2020_crosscheck.json --set /study/to=2.8 ${rough[*]}"
    [gear]="gear tang2020.json"
  )
  for study in "${!arguments[@]}"; do
    read -r -a words <<<"${arguments[$study]}"
    code=$(code_of "$epicyclic" "${words[0]}" "$inputs/${words[1]}" -o "out/$study" "${words[@]:2}")
    [ "$code" = 0 ] || [ "$code" = 1 ] || fail "$study: exit $code: $(tail -n 3 stderr)"
  done
}

# The blocks of a page that are marked as $2, one after another.
blocks_of() {
  awk -v mark="\`\`\`$2" '/^```/ { if (inside) print ""; inside = !inside && $0 == mark; next } inside' "$1"
}
