#!/usr/bin/env bash
# fresh.sh FOLDER [small]
#
# Called by tests/fresh_debian --packages, as root on a fresh Debian 12: installs the packages in FOLDER,
# computes the main job, and tries what the packages bring. Purged, they leave nothing. Prints sizes, and
# seconds and CPU seconds of each step; exit code 1 if something fails.
set -euo pipefail
folder=$1
failed=0
fail() { echo "FAILED: $1" && failed=1; }
export DEBIAN_FRONTEND=noninteractive
files() { find / -xdev \( -path /proc -o -path /dev -o -path /tmp -o -path /root -o -path /var \) -prune -o -print | sort; }

apt-get -q update >/dev/null
apt-get -q install -y --no-install-recommends man-db bash-completion lsb-release >/dev/null
files >/tmp/before
size_before=$(du -sxk --exclude=/var / 2>/dev/null | cut -f 1)

# The program alone, as a newcomer installs it.
cd /tmp
begun=$(date +%s.%N)
since() { awk -v a="$begun" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }'; }
echo "$(nproc) cores, load $(cut -d ' ' -f 1-3 /proc/loadavg)"
# "small": without what gnuplot recommends.
small=()
[ "${2:-}" != small ] || small=(--no-install-recommends gnuplot-nox fonts-dejavu-core)
TIMEFORMAT='apt: %R s, CPU %U + %S s'
time apt-get -q install -y "${small[@]}" "$folder"/epicyclic_*.deb >/tmp/apt.log 2>&1 || { cat /tmp/apt.log && exit 1; }
installed=$(since)
! command -v g++ cc >/dev/null || fail "a compiler is there"
TIMEFORMAT='main job: %R s, CPU %U + %S s'
time epicyclic sweep tang2020_printed_speed >/tmp/job.log 2>&1 || { cat /tmp/job.log && fail "the main job"; }
TIMEFORMAT='report: %R s, CPU %U + %S s'
time epicyclic report out/tang2020_printed_speed >/dev/null 2>&1 || fail "report"
done_after=$(since)
echo "installed after $installed s, $(($(du -sxk --exclude=/var / 2>/dev/null | cut -f 1) - size_before)) kB with all that it needs"
for file in figures/bifurcation_delta_sp.png sweep.md report.html; do
  [ -s out/tang2020_printed_speed/$file ] || fail "the main job left no $file"
done
echo "figure and report after $done_after s from the beginning of apt, load $(cut -d ' ' -f 1-3 /proc/loadavg)"
epicyclic doctor || fail "doctor"

apt-get -q install -y "$folder"/*.deb >/tmp/apt.log 2>&1 || { cat /tmp/apt.log && exit 1; }
echo "all packages after $(since) s"
python3 -c 'import epicyclic as ep; r = ep.open("out/tang2020_printed_speed"); print(r); assert len(r.points) == 1322' ||
  fail "Python"
python3 -c 'import epicyclic as ep; p = ep.Stage.load("/usr/share/epicyclic/inputs/tang2020_speed.json").point(value=2.16)
assert (p["regime"], p["period"]) == ("periodic", 1), p' || fail "computing in Python"
for page in epicyclic epicyclic-sweep epicyclic-mpi; do
  [ "$(man -P cat $page 2>/dev/null | wc -l)" -gt 20 ] || fail "man $page"
done
completed() {
  bash -c '
    source /usr/share/bash-completion/bash_completion
    COMP_LINE=$1 COMP_POINT=${#1} COMP_WORDS=($2) COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _completion_loader epicyclic
    _epicyclic epicyclic
    printf "%s\n" "${COMPREPLY[@]}"' bash "$1" "${2:-$1}"
}
completed 'epicyclic swe' | grep -qx sweep || fail "completion of a command"
completed 'epicyclic sweep tang2020_pri' | grep -qx tang2020_printed || fail "completion of an input"
completed 'epicyclic run --from out/tang2020_printed_speed:up=2.1' \
  'epicyclic run --from out/tang2020_printed_speed : up = 2.1' | grep -q '^2\.1' || fail "completion of a point"
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 epicyclic-mpi sweep \
  tang2020_speed -o /tmp/ranks --threads 1 --set /study/points=5 --set /study/crosscheck/points=0 >/tmp/mpi.log 2>&1 ||
  { cat /tmp/mpi.log && fail "epicyclic-mpi"; }
# Claims by name are found, and refused for the key only.
epicyclic reproduce tang2020 -o /tmp/none --set /nothing=1 2>/tmp/refusal || true
grep -q "/nothing: " /tmp/refusal || fail "claims by name: $(</tmp/refusal)"

apt-get -q purge -y epicyclic epicyclic-mpi libepicyclic-dev python3-epicyclic >/dev/null
left=$(files | comm -13 /tmp/before - | grep epicyclic || true)
[ -z "$left" ] || fail "purge leaves $left"
[ ! -e /usr/share/epicyclic ] || fail "purge leaves /usr/share/epicyclic"
left=$(find /var -xdev -name '*epicyclic*' ! -path '/var/log/*' | head)
[ -z "$left" ] || fail "purge leaves $left"
[ $failed = 0 ] && echo "all passed"
exit $failed
