#!/usr/bin/env bash
# figures.sh EPICYCLIC SOURCE_DIR
#
# Figures of every command: of names and folders as somebody may type them, executing nothing; a figure that was not
# drawn is never exit 0; corners in a phase portrait are too small to be seen.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

command -v gnuplot >/dev/null || skip "gnuplot is not installed"
short='"transient_periods": 20, "recorded_periods": 16'
stage="\"stage\": \"$inputs/tang2020.json\", \"operation\": { \"mesh_frequency_ratio\": 2.8 }"
study() { echo "{ $stage, \"study\": { \"kind\": \"$1\", $short, $2 } }" >"$1.json"; }
study run '"history_periods": 8, "spectrum_periods": 16, "exponent_periods": 20, "check_tolerance": 1e-6'
study sweep '"from": 2.8, "to": 2.9, "points": 2, "directions": ["up", "down"]'
study map '"first": { "parameter": "mesh_frequency_ratio", "from": 2.8, "to": 2.9, "points": 2 }, "second": { "parameter": "damping_ratio", "from": 0.05, "to": 0.06, "points": 2 }'
study basins '"first": { "component": "x_s", "from": -1, "to": 1, "points": 2 }, "second": { "component": "w_s_rate", "from": -1, "to": 1, "points": 2 }'
study tolerance '"from": 2.8, "to": 2.8, "points": 1, "methods": ["arkode-dopri5"], "tolerances": [1e-6, 1e-7], "clearance_smoothings": [0.05, 0.02]'
study crosscheck '"from": 2.8, "to": 2.8, "points": 1, "methods": ["arkode-dopri5", "cvode-adams"]'
cp "$inputs/tang2020.json" gear.json

# A name for each command, as in JSON, and as its title reads in an SVG file.
declare -A typed shown
typed[gear]="'quoted' it''s" shown[gear]="'quoted' it''s"
typed[run]="'; system('touch touched'); '" shown[run]="'; system('touch touched'); '"
typed[sweep]='`touch touched` $(touch touched)' shown[sweep]='`touch touched` $(touch touched)'
typed[map]='a}b{ x^2_i @ARG1 ~z' shown[map]='a}b{ x^2_i @ARG1 ~z'
typed[basins]='back\\slash \\U+0041 %s' shown[basins]='back\slash \U+0041 %s'
typed[tolerance]='\"; set output \"touched\"; | ! #' shown[tolerance]='"; set output "touched"; | ! #'
typed[crosscheck]='two\nlines\t{/Symbol W} -persist' shown[crosscheck]='two lines {/Symbol W} -persist'
folder="-it's ''\`touch touched\` \$(touch touched) {x}"
for command in gear run sweep map basins tolerance crosscheck; do
  out="./$folder/$command"
  mkdir -p "./$folder"
  code=$(code_of "$epicyclic" "$command" "$command.json" -o "$out" --set "/name=\"${typed[$command]}\"")
  [ "$code" = 0 ] || fail "$command of a hostile name ended with $code: $(<stderr)"
  count=0
  for figure in "$out"/figures/*.gp; do
    count=$((count + 1))
    [ -s "${figure%.gp}.png" ] && [ -s "${figure%.gp}.svg" ] || fail "$command: $figure was not drawn"
    perl -0pe 's/<[a-z\/!?][^>]*>//gs; s/\n\s*//g; s/&lt;/</g; s/&gt;/>/g; s/&amp;/&/g' "${figure%.gp}.svg" |
      grep -qaF -- "${shown[$command]}" || fail "$command: the title of $figure does not read ${shown[$command]}"
  done
  [ "$count" -ge 1 ] || fail "$command drew nothing"
done
[ -z "$(find . -name touched)" ] || fail "a name was executed"

# The longest distance between a portrait's line and a curve through its points [pixels of a frame of 1600 x 950].
without_drawing
code=$(code_of "$epicyclic" run run.json -o slow --set /operation/mesh_frequency_ratio=0.3 --set /study/transient_periods=100 --set /study/exponent_periods=0)
[ "$code" = 0 ] || fail "the slow run ended with $code: $(<stderr)"
perl -ne '
  if (/^(\S+) (\S+)$/) { push @{$sets[$set]}, [$1, $2] } elsif (/^$/ && $blank++ % 2) { $set++ }
  END {
    my ($line) = sort { @$b <=> @$a } grep { $_ } @sets;
    my @scale = (1600, 950);
    for my $k (0, 1) {
      my @v = sort { $a <=> $b } map { $_->[$k] } @$line;
      $scale[$k] /= $v[-1] - $v[0];
    }
    for my $i (2 .. $#$line) {
      my @p = map { my $j = $_; [map { $scale[$_] * $line->[$j][$_] } 0, 1] } $i - 2 .. $i;
      my @d = map { $p[1][$_] - ($p[0][$_] + $p[2][$_]) / 2 } 0, 1;
      my $bow = sqrt($d[0]**2 + $d[1]**2) / 4;
      $most = $bow if $bow > $most;
    }
    print "$most\n";
    exit($most > 0 && $most < 0.5 ? 0 : 1);
  }' slow/figures/phase_portrait.dat >bow || fail "corners of the phase portrait stand $(<bow) pixels off the curve"

# gnuplot fails, or is not there: the data are written, and the exit code says that something is missing.
mkdir broken absent
printf '#!/bin/sh\necho "no such terminal" >&2\nexit 1\n' >broken/gnuplot
chmod +x broken/gnuplot
for command in gear run sweep map basins tolerance crosscheck; do
  for gnuplot in broken absent; do
    path=$PWD/broken:$PATH
    [ "$gnuplot" = broken ] || path=$PWD/absent
    code=$(PATH=$path code_of "$epicyclic" "$command" "$command.json" -o "$gnuplot.$command")
    [ "$code" = 1 ] || fail "$command with gnuplot $gnuplot ended with $code"
    grep -q "not drawn: " stderr || fail "$command with gnuplot $gnuplot does not say what was not drawn: $(<stderr)"
    grep -q '"state": "complete"' "$gnuplot.$command/run.json" || fail "$command with gnuplot $gnuplot is not complete"
  done
done
finish
