#!/usr/bin/env bash
# reference.sh EPICYCLIC SOURCE_DIR
#
# The pages of the reference that docs/generate writes are those of the program as it is, and file_formats.md has each
# column of each other table of small studies.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source_dir=$2
reference=$source_dir/docs/reference

mkdir pages
without_drawing
code=$(code_of "$source_dir/docs/generate" "$epicyclic" "$PWD/pages")
[ "$code" = 0 ] || [ "$code" = 3 ] || fail "docs/generate ended with $code: $(<stderr)"
for page in keys.md commands.md columns.md; do
  # Without h5dump (3) the columns are left to test_reports.
  [ "$page $code" != "columns.md 3" ] || continue
  [ $page != keys.md ] || has_claims || continue
  diff "$reference/$page" "pages/$page" >difference ||
    fail "docs/reference/$page is stale: run docs/generate; first differences: $(head -n 6 difference)"
done
# Generated or not, no page names a command that is not there.
while IFS= read -r command; do
  "$epicyclic" "$command" --help >/dev/null 2>&1 || fail "commands.md names $command, which is no command"
done < <(sed -n 's/^## //p' "$reference/commands.md")

few=(--set /study/transient_periods=2 --set /study/recorded_periods=4 --set /study/classification_periods=0)
plane=(--set /study/first/points=2 --set /study/second/points=2 --set /study/transient=fixed)
rough=(--set /study/transient_periods=20 --set /study/recorded_periods=16)
studies=(
  "sweep tang2020_speed.json --set /study/points=3 --set /study/crosscheck/points=0 ${few[*]}"
  "basins tang2020_basins.json ${plane[*]} ${few[*]}"
  "continue tang2020_loci.json --set /study/period_max=1 --set /study/orbits=2 --set /study/branches=1 --set /study/transient_periods=40 --set /study/tolerance=1e-7"
  "run tang2020_run.json --set /study/transient=fixed ${few[*]} --set /study/exponent_periods=2 --set /study/spectrum_periods=4 --set /study/history_periods=2 --set /study/check_tolerance=1e-6"
  "tolerance tang2020_tolerance.json --set /study/points=1 --set /study/from=2.8 ${rough[*]} --set /study/tolerances=[1e-5,1e-6] --set /study/methods=[\"arkode-dopri5\"] --set /study/chaotic_periods=64"
  "crosscheck tang2020_crosscheck.json --set /study/points=1 --set /study/from=2.8 --set /study/to=2.8 ${rough[*]} --set /study/methods=[\"arkode-dopri5\",\"cvode-adams\"]"
  "ramp tang2020_ramp.json --set /study/rate_per_tau=0.02 --set /study/hold_periods=2"
  "gear tang2020.json"
)
for study in "${studies[@]}"; do
  read -r -a words <<<"$study"
  code=$(code_of "$epicyclic" "${words[0]}" "$inputs/${words[1]}" -o "${words[0]}" "${words[@]:2}")
  [ "$code" = 0 ] || [ "$code" = 1 ] || fail "${words[0]}: exit $code: $(tail -n 3 stderr)"
done
tables=0
for table in */*.csv; do
  name=${table##*/}
  tables=$((tables + 1))
  grep -qF "\`$name\`" "$reference/file_formats.md" || fail "file_formats.md does not name $name"
  # Columns of a generated page; of the others numbered ones and states stand for one of their kind.
  while IFS= read -r column; do
    case $column in
      [xyuw]_* | lambda_* | elastic_* | kinetic_* | *_um | *_m_per_s) continue ;;
      *_[1-9] | *_[1-9]_*) column=$(sed -E 's/_[1-9](_|$)/_1\1/' <<<"$column") ;;
    esac
    case $column in delta_?p_1_rate | load_sharing_?p_1 | force_?p_1 | bearing_planet_1 | delta_?p_1) column=${column/rp/sp} ;; esac
    grep -qF "\`$column\`" "$reference/file_formats.md" "$reference/columns.md" ||
      fail "neither file_formats.md nor columns.md has the column $column of $table"
  done < <(head -n 1 "$table" | tr ',' '\n')
done
[ "$tables" -ge 20 ] || fail "only $tables tables were found"
echo "$tables tables"
finish
