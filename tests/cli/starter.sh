#!/usr/bin/env bash
# starter.sh EPICYCLIC SOURCE_DIR
#
# `init`: a set of one's own from a drawing's numbers, every file of it valid without a warning about what init itself chose,
# nothing written over; sets whose planets cannot be spaced evenly. `keys`: each key of the schema, a line each.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
without_drawing

[ "$(code_of "$epicyclic" init mine)" = 0 ] || fail "init: $(<stderr)"
[ -z "$(<stderr)" ] || fail "init warns of what it chose: $(<stderr)"
for name in stage speed point; do [ -s "mine/$name.json" ] || fail "$name.json is missing"; done
# The commands that it names are there to be typed.
grep -F "  $epicyclic " stdout >next
[ "$(wc -l <next)" = 3 ] || fail "next: $(<stdout)"
while read -r _ command; do
  read -r -a words <<<"$command"
  # Few points, and what is said of its time is measured by one thread, of short points: that it runs is enough.
  [ "${words[0]}" = sweep ] && words+=(--set /study/points=3 --set /study/transient_periods=5 --set /study/classification_periods=0 --set /study/crosscheck/points=0)
  [ "${words[0]}" = check ] && words+=(--threads 1 --set /study/transient_periods=5 --set /study/classification_periods=0 --set /study/crosscheck/points=0)
  [ "$(code_of "$epicyclic" "${words[@]}")" = 0 ] || fail "$command: $(<stderr)"
done <next
cp -r mine before
[ "$(code_of "$epicyclic" init mine)" = 2 ] || fail "init over itself"
diff -r mine before >/dev/null || fail "init wrote over what was there"

# Drawings: three and five planets, even and uneven spacing, given shifts, a rated speed.
# A light load is what it is warned of, once: then the estimated error decides the regime.
warnings=0
drawing() {
  rm -rf set
  [ "$(code_of "$epicyclic" init set "$@")" = 0 ] || fail "init $*: $(<stderr)"
  [ "$(wc -l <stderr)" = $warnings ] || fail "init $* warns: $(<stderr)"
  for name in speed point; do
    [ "$(code_of "$epicyclic" check "set/$name.json" --no-time)" = 0 ] || fail "check of init $*: $(<stderr)"
    [ "$(grep -c '^warning' stderr)" = $warnings ] || fail "init $*: $(<stderr)"
    [ "$(grep -c '^warning.* um: the estimate decides the regime' stderr)" = $warnings ] || fail "init $*: $(<stderr)"
    grep -q '^amplitude of the transmission error: sun-planet [0-9.]* um on a static deflection of [0-9.]* um' stderr ||
      fail "no error against the deflection: $(<stderr)"
  done
  [ "$(code_of "$epicyclic" gear set/stage.json -o set/gear)" = 0 ] || fail "gear of init $*: $(<stderr)"
}
warnings=1
drawing --teeth 21,28,77 --module 3 --width 30 --torque 120 --speed 3000
warnings=0
drawing --teeth 21,28,77 --module 3 --width 30 --torque 480 --speed 3000
# The whole curve of the stiffness, and ranges of what no drawing gives, which the modes follow.
grep -q '"form": "curve"' set/stage.json || fail "harmonics in place of the curve"
grep -q '^mode,.*,frequency_low_Hz,frequency_high_Hz$' set/gear/modes.csv || fail "modes without ranges: $(head -1 set/gear/modes.csv)"
grep -q '"angles_deg"' set/stage.json || fail "98 teeth and three planets, but no angles"
# Of a drawing is what was given, and nothing else.
[ "$(grep -c '"module_mm": "source: drawing"' set/stage.json)" = 3 ] || fail "the origin of a module that was given"
[ "$(grep -c '"profile_shift": "choice: not given' set/stage.json)" = 3 ] || fail "the origin of a shift that was not given"
[ "$(grep -c '"pressure_angle_deg": "choice: not given' set/stage.json)" = 3 ] || fail "the origin of an angle that was not given"
grep -q '"sun_speed_rpm"' set/speed.json || fail "no speeds in rpm"
drawing --teeth 20,25,70 --module 2 --planets 3
grep -q '"angles_deg"' set/stage.json && fail "90 teeth and three planets, but angles"
drawing --teeth 28,20,68 --module 3 --planets 5 --shifts 0,0.3,0.6
drawing --teeth 30,21 --module 1.5 --planets 4 --pressure-angle 25
drawing --teeth 24,30,84 --module 4 --shifts 0.3,0.1,0.5 --torque 2000 --width 80

# Values that no drawing gives go with the size: stages that are alike have modes in the same places.
for module in 1.5 6; do
  drawing --teeth 30,21,72 --module $module --width "$(awk "BEGIN { print 10 * $module }")"
  tail -n +3 set/gear/modes.csv | cut -d, -f3 >"modes.$module"
done
paste modes.1.5 modes.6 | awk '{ if ($1 / $2 > 1.1 || $1 / $2 < 0.9) exit 1 }' || fail "modes of module 1.5 and 6: $(paste modes.1.5 modes.6)"

# A lone pair: no planets, no ring, gears that only rotate.
rm -rf pair
[ "$(code_of "$epicyclic" init pair --pair --teeth 20,31 --module 4 --shifts 0.3,0.1 --torque 300 --speed 3000)" = 0 ] || fail "init --pair: $(<stderr)"
[ -z "$(<stderr)" ] || fail "init --pair warns: $(<stderr)"
grep -q '"boundary": "pair"' pair/stage.json || fail "no pair"
grep -q '"ring"\|"planets"\|"carrier"' pair/stage.json && fail "a ring of a pair"
[ "$(code_of "$epicyclic" gear pair/point.json -o pair/gear)" = 0 ] || fail "gear of a pair: $(<stderr)"
[ "$(code_of "$epicyclic" check pair/speed.json --no-time)" = 0 ] || fail "check of a pair: $(<stderr)"

# Planets where the drawing has them.
drawing --teeth 21,28,77 --angles 0,117.551020408,238.775510204
grep -c '117.551020408' set/stage.json >/dev/null || fail "angles of the drawing are not in the stage"

refused() {
  rm -rf refused
  [ "$(code_of "$epicyclic" "$@")" = 2 ] || fail "exit code of $*: $(<stderr)"
  [ ! -e refused ] || fail "$* left a folder"
}
refused init
refused init refused --teeth 21
refused init refused --teeth 21,x
refused init refused --teeth 3,28,77
refused init refused --module 5e-324
refused init refused --teeth 21,28,90
grep -q '^init: /stage/catalogue/ring' stderr || fail "told of a file that is not kept: $(<stderr)"
refused init refused --angles 0,90,180 --planets 4
refused init refused --angles 0,40.4081633,180
grep -q 'angles_deg: neighbouring planets overlap' stderr || fail "overlap of given angles: $(<stderr)"
# Planets that cannot be assembled: the nearest angles, which can.
refused init refused --teeth 21,28,77 --angles 0,120,240
nearest=$(sed -n 's/^.*the nearest such angles are //p' stderr)
[ -n "$nearest" ] || fail "no nearest angles: $(<stderr)"
drawing --teeth 21,28,77 --angles "$nearest"
refused init refused --module 0
refused init refused --planets 9
refused init refused --torque -3
refused init refused --shifts 0,0
refused init refused --pair --shifts 0,0,0
refused init refused --pair --teeth 20,31,82
grep -q '^init: --teeth of a pair are two' stderr || fail "three gears of a pair: $(<stderr)"
refused init refused --pair --planets 3
refused init refused --pair --angles 0,180
refused init refused --pair --teeth 20,4

# Each key once, in the schema's own words.
[ "$(code_of "$epicyclic" keys)" = 0 ] || fail "keys: $(<stderr)"
[ "$(wc -l <stdout)" -gt 300 ] || fail "keys: only $(wc -l <stdout)"
[ "$(sort stdout | uniq -d | wc -l)" = 0 ] || fail "keys: some twice: $(sort stdout | uniq -d | head -3)"
[ "$(code_of "$epicyclic" keys backlash mesh)" = 0 ] || fail "keys backlash mesh"
[ "$(cut -d' ' -f1,2 stdout | grep -c '^/stage/lumped/.*_planet_mesh/backlash_half_um \[um\]$')" = 2 ] || fail "keys backlash mesh: $(<stdout)"
[ "$(code_of "$epicyclic" keys transient_periods)" = 0 ] || fail "keys transient_periods"
grep -q '^/study/transient_periods  default 300; 0 to 10000000  .*(sweep, map, basins, run' stdout || fail "kinds: $(<stdout)"
refused keys backlsh
grep -q "did you mean 'backlash'" stderr || fail "keys: no suggestion: $(<stderr)"
finish
