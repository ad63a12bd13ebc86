#!/usr/bin/env bash
# plot.sh EPICYCLIC SOURCE_DIR
#
# `plot`: figures of what is stored, of sweeps, branches, maps and runs, without computing: the journal may be gone. Several
# folders in one figure, units, sizes, formats, the same bytes again; bad input.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

few=(--set /study/transient_periods=40 --set /study/recorded_periods=16 --set /study/classification_periods=0)
swept() {
  "$epicyclic" sweep "$inputs/tang2020_speed_fixed_ring.json" -o "$1" --set /study/from=2 --set /study/to=2.2 --set /study/points=6 \
    --set /integrator/relative_tolerance=1e-6 "${few[@]}" "${@:2}" >/dev/null 2>&1 || fail "the sweep $1"
}
swept one
swept two --set /stage/lumped/sun_planet_mesh/damping_ratio=0.08
"$epicyclic" map "$inputs/tang2020_map.json" -o map --set '/study/directions=["up", "down"]' --set /study/first/points=3 --set /study/second/points=2 "${few[@]}" >/dev/null 2>&1 || fail "the map"
"$epicyclic" run "$inputs/tang2020_run.json" -o run --set /study/transient=fixed "${few[@]}" --set /study/exponent_periods=0 \
  --set /study/spectrum_periods=16 --set /study/history_periods=2 >/dev/null 2>&1 || fail "the run"
"$epicyclic" continue "$inputs/tang2020_branches_fixed_ring.json" -o branches --set /study/from=2.1 --set /study/to=2.3 --set '/study/starts=[2.25]' \
  --set /study/period_max=1 --set /study/tolerance=1e-8 --set /study/branch_points=false >/dev/null 2>&1 || fail "the branches"
rm one/journal.bin
cp -r one before

# The figure's data are the table's; up and down have frames of their own where there are many values over each speed.
[ "$(code_of "$epicyclic" plot one -o figures --quantity delta_sp_rms --quantity delta_sp_1)" = 0 ] || fail "plot: $(<stderr)"
[ "$(<stdout)" = "$(printf 'figure: figures/%s\n' delta_sp_rms.png delta_sp_rms.svg delta_sp_1.png delta_sp_1.svg)" ] || fail "what it says: $(<stdout)"
for file in delta_sp_rms delta_sp_1; do
  for kind in png svg gp dat; do [ -s "figures/$file.$kind" ] || fail "$file.$kind is missing"; done
done
column() { awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) at = k; next } { print $at }' "$1"; }
column one/points.csv delta_sp_rms | sort -u >expected
awk 'NF >= 2 { print $2 }' figures/delta_sp_rms.dat | sort -u >drawn
cmp expected drawn || fail "delta_sp_rms.dat is not the column"
column one/poincare.csv delta_sp_1 | sort -u >expected
awk 'NF == 2 { print $2 }' figures/delta_sp_1.dat | sort -u >drawn
[ "$(comm -23 drawn expected | wc -l)" -le 1 ] || fail "delta_sp_1.dat has what the section has not"
[ "$(grep -c '^plot' figures/delta_sp_1.gp)" = 2 ] || fail "up and down in one frame"
grep -q 'Sun speed' figures/delta_sp_1.gp || fail "no speed in rpm"
diff -r one before >/dev/null || fail "the study was changed"

# Units, the other abscissa, sizes; a PDF, too, is the same bytes again.
again() {
  [ "$(code_of "$epicyclic" plot one two -o "$1" --quantity delta_sp_range --x sun_speed_rpm --um --label 'ζ = 0.05' --label "it's 0.08" --title 'a \n b' \
    --size 900x600 --font 18 --x-range 40000:80000 --y-range 0.1:100 --log --format pdf --format png)" = 0 ] || fail "options: $(<stderr)"
}
again first
sleep 1
again second
[ ! -e first/delta_sp_range_over_sun_speed_rpm.svg ] || fail "a format that nobody asked for"
for kind in pdf png gp dat; do
  cmp "first/delta_sp_range_over_sun_speed_rpm.$kind" "second/delta_sp_range_over_sun_speed_rpm.$kind" || fail "$kind twice"
done
grep -q 'µm' first/*.gp || fail "no micrometres"
grep -q 'size 900,600' first/*.gp || fail "another size"
um=$(column one/points.csv delta_sp_range | head -1)
awk -v um="$um" 'NF >= 2 && $2 / um > 9.9999999 && $2 / um < 10.0000001 { found = 1 } END { exit !found }' first/*.dat || fail "micrometres"

# Cells and points that were not reached have no place; those on their way are told.
# spoiled FROM TO AWK: a copy whose points.csv is another, as if the study had left it so.
spoiled() {
  cp -r "$1" "$2"
  awk -F, -v OFS=, "NR == 1 { for (k = 1; k <= NF; ++k) at[\$k] = k } $3 { print }" "$1/points.csv" >"$2/points.csv"
  local was is
  was=$(sha256sum <"$1/points.csv") && is=$(sha256sum <"$2/points.csv")
  sed -i "s/${was%% *}/${is%% *}/; s/\"bytes\": $(stat -c %s "$1/points.csv"),/\"bytes\": $(stat -c %s "$2/points.csv"),/" "$2/run.json"
}
spoiled map lost 'NR == 2 { $at["status"] = "step_limit" } NR == 3 { $at["converged"] = 0 }'
spoiled one lost_points 'NR == 2 { $at["status"] = "step_limit" }'
[ "$(code_of "$epicyclic" plot lost -o lost_figures --quantity dynamic_factor_sp)" = 0 ] || fail "a map with a cell that was not reached: $(<stderr)"
grep -q '1 point was not reached and left out' stderr && grep -q 'the record of 1 point has not converged' stderr || fail "it is not said: $(<stderr)"
[ "$(code_of "$epicyclic" plot lost_points -o lost_figures --quantity delta_sp_1)" = 0 ] || fail "a section with a point that was not reached: $(<stderr)"
[ "$(grep -c '^2 ' lost_figures/delta_sp_1.dat)" -lt "$(grep -c '^2 ' figures/delta_sp_1.dat)" ] || fail "a point that was not reached is drawn"
# Lines change where the branch does: at the flip, and not at the next orbit.
"$epicyclic" plot branches -o stability --quantity multiplier_max >/dev/null 2>stderr || fail "multipliers: $(<stderr)"
flip=$(awk -F, '$2 == "flip" { print $3; exit }' branches/special.csv)
awk -v flip="$flip" 'NF >= 2 && $1 - flip < 1e-9 && flip - $1 < 1e-9 && $2 > 0.99 && $2 < 1.01 { n++ } END { exit n < 2 }' stability/multiplier_max.dat || fail "no end of both lines at the flip $flip"

# A column by its beginning.
[ "$(code_of "$epicyclic" plot one -o refused --quantity K_v)" = 2 ] && grep -q "did you mean 'kv_sp'?" stderr || fail "K_v: $(<stderr)"

# Branches over a sweep, a map, a run; JSON.
[ "$(code_of "$epicyclic" plot one branches -o figures --quantity delta_rp_rms --json)" = 0 ] || fail "branches: $(<stderr)"
grep -q '"figures/delta_rp_rms.png"' stdout || fail "json: $(<stdout)"
grep -q unstable figures/delta_rp_rms.gp || fail "branches: no legend"
# Poincare points of branches are lines: each point of the table is one of theirs.
[ "$(code_of "$epicyclic" plot one branches -o sections --quantity delta_sp_1)" = 0 ] || fail "sections of branches: $(<stderr)"
awk -F '[, ]+' 'FNR == 1 && NR != FNR { for (k = 1; k <= NF; ++k) if ($k == "delta_sp_1") column = k; next }
  NR == FNR { if (NF >= 2) drawn[sprintf("%.8f", $2)] = 1; next }
  { ++all; if (!(sprintf("%.8f", $column) in drawn)) exit 1 } END { exit all < 5 }' sections/delta_sp_1.dat branches/poincare.csv ||
  fail "a Poincare point of a branch is not drawn"
[ "$(code_of "$epicyclic" plot map -o figures --quantity dynamic_factor_sp --format svg)" = 0 ] || fail "a map: $(<stderr)"
[ -s figures/dynamic_factor_sp_up.svg ] || fail "a map: no figure"
# Each cell of a map stands where its values are, whichever way it was come to.
[ "$(code_of "$epicyclic" plot map -o figures --quantity value --format svg)" = 0 ] || fail "a map's values: $(<stderr)"
for way in up down; do
  awk 'NF == 5 && ($5 < $1 || $5 > $2) { exit 1 }' "figures/value_$way.dat" || fail "a map, $way: $(<"figures/value_$way.dat")"
done
# What a logarithm has no place for is told; "delta_sp" is that of planet 1; forces have no micrometres, and need none.
[ "$(code_of "$epicyclic" plot one -o figures --quantity lyapunov_max --log --format svg)" = 1 ] || fail "no positive value: $(<stderr)"
[ "$(code_of "$epicyclic" plot one -o figures --quantity planet_spread --log --format svg)" -le 1 ] || fail "log: $(<stderr)"
[ "$(code_of "$epicyclic" plot one -o figures --quantity delta_sp --quantity force_sp_max --um --format svg)" = 0 ] || fail "delta_sp: $(<stderr)"
[ -s figures/force_sp_max.svg ] || fail "no figure of a force"
# Pictures of other formats stay.
[ "$(code_of "$epicyclic" plot one -o figures --quantity delta_sp --format pdf)" = 0 ] || fail "pdf: $(<stderr)"
[ -s figures/delta_sp_1.svg ] && [ -s figures/delta_sp_1.pdf ] || fail "a picture of another format is gone"
[ "$(code_of "$epicyclic" plot run -o figures --quantity force_sp_1)" = 0 ] || fail "a run: $(<stderr)"
grep -q 'Mesh periods' figures/force_sp_1.gp || fail "a run: abscissa"

refused() {
  [ "$(code_of "$epicyclic" plot "$@")" = 2 ] || fail "exit code of plot $*: $(<stderr)"
  [ "$(wc -l <stderr)" -le 2 ] || fail "plot $*: $(<stderr)"
  [ ! -e refused ] || fail "plot $* left a folder"
}
refused one
refused -o refused
refused nowhere -o refused
refused one -o one
refused one -o refused --quantity delta_sp_rmsx
refused one -o refused --quantity regime
refused one -o refused --quantity ../evil
refused one -o refused --x nothing
refused one -o refused --x contact_sp
refused one map -o refused
refused one run -o refused
refused one -o one/figures
refused map -o refused --quantity delta_sp_rms --log
refused map -o refused --quantity delta_sp_rms --x sun_speed_rpm
refused one -o refused --x-range 3:2
refused one -o refused --x-range 3
refused one -o refused --y-range 0:inf
refused one -o refused --log --y-range 0:1
refused one -o refused --size 10x10
refused one -o refused --size 1800
refused one -o refused --font 1
refused one -o refused --format gif
refused one -o refused --label a --label b
refused one -o refused --size 300x300 --font 90
echo >>one/points.csv
[ "$(code_of "$epicyclic" plot one -o refused)" = 7 ] || fail "a changed table: $(<stderr)"
finish
