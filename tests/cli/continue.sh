#!/usr/bin/env bash
# continue.sh EPICYCLIC SOURCE_DIR
#
# `continue`: tables, figures, the same bytes after kills and a signal; seeds from finished studies, which may vanish; a sweep
# proved by branches, and one that is not; bad input. With WHOLE=yes what takes longest too: loci cut by kills, smooth widths.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

study=$inputs/tang2020_branches.json
# The last flip of the speed diagram and what is born there.
small=(--set /study/from=2.1 --set /study/to=2.2 --set '/study/starts=[2.18]' --set /study/tolerance=1e-9)
branches() { "$epicyclic" continue "$study" "${small[@]}" "$@"; }

result_files=(branch.csv special.csv branches.csv poincare.csv results.h5 continue.md input.json input.resolved.json
  figures/branches_delta_sp.dat)

[ "$(code_of branches -o whole)" = 0 ] || fail "continue: $(<stderr)"
is_drawn whole/figures/branches_delta_rp
head -1 whole/branch.csv | grep -q '^branch,index,value,period,stable,multiplier_max,' || fail "columns of branch.csv"
[ "$(head -1 whole/special.csv | cut -d, -f1-6)" = branch,kind,value,error_bound,period,multipliers ] ||
  fail "columns of special.csv"
# The flip is where both branches know it, within the bound; what is born there is stable.
flip=$(awk -F, '$1 == 0 && $2 == "flip" { print $3; exit }' whole/special.csv)
awk -v flip="$flip" 'BEGIN { exit !(flip > 2.148946 && flip < 2.148947) }' || fail "the flip is at $flip"
awk -F, '$1 == 0 && $2 == "flip" { exit !($4 > 0 && $4 < 1e-6) }' whole/special.csv || fail "its bound"
[ "$(sed -n 3p whole/branches.csv | cut -d, -f1-2,8,10)" = 1,2,birth,0:0 ] || fail "branch 1: $(sed -n 3p whole/branches.csv)"
awk -F, '$1 == 1 && $2 == 3 { stable = $5 } END { exit !stable }' whole/branch.csv || fail "the doubled orbits are not stable"
awk -F, '$1 == 0 && $3 == 2.2 && $5 == 1 { found = 1 } END { exit !found }' whole/branch.csv || fail "no orbit at the end"

# Speeds of a special point are those of its value, to rounding: their ratio is that of each orbit.
awk -F, 'FNR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  { ratio = $at["sun_speed_rpm"] / $at["value"] }
  FILENAME ~ /branch.csv/ { orbit = ratio; next }
  { ++points; if ((ratio / orbit - 1) ^ 2 > 1e-28) exit 1 }
  END { if (!points) exit 1 }' whole/branch.csv whole/special.csv || fail "speeds of special points are not those of their values"

# Complete; another study.
[ "$(code_of branches -o whole --threads 1)" = 0 ] || fail "a complete folder must give exit 0: $(<stderr)"
grep -q 'complete already' stderr || fail "a complete folder is said to be so: $(<stderr)"
[ "$(code_of branches -o whole --set /study/period_max=1)" = 3 ] || fail "another study must give exit 3"

# The resolved input, stopped, and then with --json: the same bytes, but of the input as it was given.
code=0
timeout -s TERM "$(or_if_slow 1 5)" "$epicyclic" continue whole/input.resolved.json -o resolved >stdout 2>stderr || code=$?
[ "$code" = 124 ] || fail "stopped: $code $(<stderr)"
[ "$(code_of "$epicyclic" continue whole/input.resolved.json -o resolved --json)" = 0 ] || fail "resolved, after a stop: $(<stderr)"
grep -q '"kind": "flip"' stdout || fail "the summary as JSON: $(<stdout)"
cmp -s whole/input.resolved.json resolved/input.json || fail "the resolved input is not the one that was given"
cp whole/input.json resolved
same_results whole resolved

# Tables are there while a study runs, with rows that stay, and are said to be partial; how long it will take is said. They
# are written after 5 s: with some orbits in the journal the study stands still for as long, and again while they are copied.
"$epicyclic" init slow >/dev/null 2>&1
cat >slow/branches.json <<END
{ "stage": "stage.json", "study": { "kind": "continue", "parameter": "mesh_frequency_ratio", "from": 0.3, "to": 0.4,
  "starts": [0.35], "period_max": 1, "tolerance": 1e-8 } }
END
"$epicyclic" continue slow/branches.json -o growing >stdout 2>stderr &
pid=$!
until [ "$(journal_bytes growing)" -gt 100000 ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
kill -STOP $pid 2>/dev/null || true
sleep 5
kill -CONT $pid 2>/dev/null || true
until [ -s growing/branches.csv ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
kill -STOP $pid 2>/dev/null || true
cp growing/branch.csv growing/branches.csv growing/run.json .
kill -TERM $pid 2>/dev/null || true
kill -CONT $pid 2>/dev/null || true
code=0
wait $pid || code=$?
[ "$code" = 75 ] || fail "stopped with tables: $code $(<stderr)"
grep -q '"state": "running"' run.json || fail "tables are no sooner there than all is done"
grep -q 'is still being continued$' branches.csv || fail "not said that they are partial: $(<branches.csv)"
[ "$(wc -l <branch.csv)" -gt 3 ] || fail "partial tables of nothing: $(<branch.csv)"
grep -q 'about .* left if no more branches are found' stderr || fail "how long it takes is not said: $(<stderr)"
[ "$(code_of "$epicyclic" continue slow/branches.json -o growing)" = 0 ] || fail "resumed: $(<stderr)"
[ -z "$(comm -23 <(cut -d, -f3- branch.csv | sort) <(cut -d, -f3- growing/branch.csv | sort))" ] || fail "rows of the partial table are not in the last one"

# A sweep over the flip, its proof by branches that are killed again and again, and seeds of it.
sweep=(--set /study/from=2.1 --set /study/to=2.2 --set /study/points=6 --set /study/transient_periods=400)
[ "$(code_of "$epicyclic" sweep "${speeds[@]}" "${sweep[@]}" -o sweep)" = 0 ] || fail "sweep: $(<stderr)"
PICTURE_TAKES=0.1 killed_until_done proved 2000 "$epicyclic" continue "$study" "${small[@]}" -o proved --against sweep
[ "$(wc -l <proved/proof.csv)" = 3 ] || fail "one change each way: $(<proved/proof.csv)"
[ "$(cut -d, -f7,8,11,12,15 proved/proof.csv | sed -n 2p)" = 'period 2,period 1,1,bifurcation,flip' ] ||
  fail "the change: $(sed -n 2p proved/proof.csv)"
is_drawn proved/figures/proof_delta_sp
grep -q '0 unexplained' proved/proof.md || fail "proof.md: $(<proved/proof.md)"
same_results whole proved
# A complete folder takes a proof later, and keeps its results.
[ "$(code_of branches -o whole --against sweep)" = 0 ] || fail "a later proof: $(<stderr)"
cmp -s whole/proof.csv proved/proof.csv || fail "a later proof is another one"
same_results whole proved
[ "$(code_of branches -o whole)" = 0 ] || fail "complete behind a proof: $(<stderr)"

# Without the doubled branch a change is unexplained to nobody, but without any branch near it is.
far=(--set /study/from=2.05 --set /study/to=2.25 --set /study/tolerance=1e-9 --set '/study/starts=[2.06]' --set /study/period=2 --set /study/period_max=2)
[ "$(code_of "$epicyclic" continue "$study" "${far[@]}" --set /study/orbits=2 -o few --against sweep)" = 1 ] ||
  fail "unexplained changes must give exit 1: $(<stderr)"
grep -q 'unexplained' few/proof.csv || fail "and be listed: $(<few/proof.csv)"
[ "$(code_of "$epicyclic" continue "$study" "${far[@]}" --set /study/orbits=2 -o few --against sweep --unexplained 2)" = 0 ] ||
  fail "two were allowed: $(<stderr)"

[ "$(code_of "$epicyclic" continue "$study" "${small[@]:0:4}" --set '/study/starts=[]' --set /study/orbits=3 --from sweep -o seeded)" = 0 ] ||
  fail "seeds of a sweep: $(<stderr)"
grep -q '"seeds"' seeded/input.resolved.json || fail "the seeds are not in the resolved input"
mv sweep gone
[ "$(code_of "$epicyclic" continue seeded/input.resolved.json -o seeded)" = 0 ] || fail "the donor vanished: $(<stderr)"
mv gone sweep
[ "$(code_of "$epicyclic" continue "$study" "${small[@]:0:4}" --set '/study/starts=[]' --set /study/orbits=3 --from sweep:1 -o seed1)" = 0 ] ||
  fail "a seed of one point: $(<stderr)"
grep -q '"period": 2' seed1/input.resolved.json || fail "its period is 2"

# The flip over the damping, from edge to edge; killed between.
loci=(--set '/study/loci={"parameter":"damping_ratio","from":0.0499,"to":0.051,"near":[2.149]}' --set /study/period_max=1 --set /study/tolerance=1e-10
  --set '/study/starts=[2.15]' --set /study/orbits=4)
[ "$(code_of branches "${loci[@]}" -o loci)" = 0 ] || fail "loci: $(<stderr)"
[ "$(head -1 loci/loci.csv | cut -d, -f1-7)" = locus,index,kind,first,second,error_bound,codimension_two ] || fail "columns of loci.csv"
[ "$(sed -n 2p loci/loci.csv | cut -d, -f1,3,5)" = 0,flip,0.0499 ] || fail "the first point: $(sed -n 2p loci/loci.csv)"
[ "$(tail -1 loci/loci.csv | cut -d, -f1,3,5)" = 0,flip,0.051 ] || fail "the last point: $(tail -1 loci/loci.csv)"
awk -F, -v flip="$flip" '$5 > 0.05 - 1e-9 && $5 < 0.05 + 1e-9 { found = $4 - flip < 1e-7 && flip - $4 < 1e-7 } END { exit !found }' loci/loci.csv ||
  fail "the locus does not begin at the flip"
is_drawn loci/figures/loci
if [ "${WHOLE:-no}" = yes ]; then
  killed_until_done loci_cut 4000 "$epicyclic" continue "$study" "${small[@]}" "${loci[@]}" -o loci_cut
  cmp -s loci/loci.csv loci_cut/loci.csv || fail "loci differ after kills"
fi

# A search at one speed: two motions of period 1 and 2, the first one unstable.
search=(--set '/study/search={"values":[2.12],"starts":3,"spread":0.01,"period_max":2}' --set '/study/starts=[]' --set /study/tolerance=1e-6)
[ "$(code_of branches "${search[@]}" --set /study/orbits=2 --set /study/branches=2 -o search)" = 0 ] || fail "search: $(<stderr)"
[ "$(cut -d, -f1,3,5 search/orbits.csv | sed 1d | tr '\n' ' ')" = '2.12,1,0 2.12,2,1 ' ] || fail "found: $(<search/orbits.csv)"

# With a smooth clearance each value is told for the exact one too.
if [ "${WHOLE:-no}" = yes ]; then
  smooth=(--set /study/from=2.14 --set /study/to=2.16 --set '/study/starts=[2.155]' --set /integrator/clearance_smoothing=0.02 --set /study/period_max=1 --set /study/tolerance=1e-10)
  [ "$(code_of branches "${smooth[@]}" -o smooth)" = 0 ] || fail "smooth: $(<stderr)"
  awk -F, -v flip="$flip" '$2 == "flip" { off = $12 - flip; found = off < $13 && -off < $13 && $13 < 1e-5 && $3 < flip - 1e-4 }
    END { exit !found }' smooth/special.csv || fail "not the exact flip: $(<smooth/special.csv)"
fi

# Bad input: nothing is written.
refused() {
  [ "$(code_of "$@" -o refused)" = 2 ] || fail "must be refused: $*"
  [ ! -e refused ] || fail "refused, but written to: $*"
}
refused branches --from sweep:100
refused branches --from "$inputs"
refused branches --from proved
refused branches --against "$inputs"
refused branches --against sweep --set /study/from=2.15
refused branches --against sweep --set /stage/load/power_kW=300
refused branches --set '/study/starts=[3]'
refused branches --set '/study/loci={"parameter":"damping_ratio","from":0.06,"to":0.07}'
refused branches --set '/study/loci={"parameter":"mesh_frequency_ratio","from":0.06,"to":3}'
refused branches --set '/study/search={"values":[3]}'
refused "$epicyclic" continue "$inputs/tang2020_speed.json"
refused "$epicyclic" sweep "$study"
echo 'x' >>sweep/points.csv
[ "$(code_of branches --from sweep:1 -o refused)" = 7 ] || fail "a changed donor must give exit 7: $(<stderr)"
[ ! -e refused ] || fail "refused, but written to"

finish
