# Sourced by the scripts here: EPICYCLIC SOURCE_DIR are theirs. They work in a folder of their own, say what fails, go on,
# and end with `finish`.

epicyclic=$1
inputs=$2/inputs
failed=0
work=$(mktemp -d)
# A figure that was being drawn when its program was killed may still come: then once more.
trap 'rm -rf "$work" 2>/dev/null || { sleep 1; rm -rf "$work"; }' EXIT
cd "$work"

# $1, or $2 in a build with sanitizers, which is tens of times slower.
or_if_slow() {
  if grep -qaE '__(asan|tsan)_init' "$epicyclic"; then echo "$2"; else echo "$1"; fi
}

# Before what starts ranks: MPI libraries keep memory until a program ends, and AddressSanitizer is not to ask for it.
leaks_of_mpi=(env "ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0")

fail() {
  echo "FAILED: $1"
  failed=$((failed + 1))
}

finish() {
  echo "$failed failures"
  [ "$failed" = 0 ]
}

# ctest's SKIP_RETURN_CODE.
skip() {
  echo "skipped: $1"
  exit 77
}

# Exit code of a command, its output in stdout and stderr.
code_of() {
  local code=0
  "$@" >stdout 2>stderr </dev/null || code=$?
  echo "$code"
}

# What a study must have the same bytes in; scripts on other kinds than sweeps have a list of their own.
result_files=(points.csv poincare.csv results.h5 input.json input.resolved.json figures/bifurcation_delta_sp.dat)
same_results() {
  local file
  for file in "${result_files[@]}"; do
    cmp -s "$1/$file" "$2/$file" || fail "$file differs between $1 and $2"
  done
}

# Kills a study again and again, later each time, at first by $1 milliseconds, until it ends by itself. By a quarter in
# the end, so that slow builds end too.
killed_until_done() {
  local step=$1 code ms kills=0
  shift
  for ((ms = step; ms < 1000 * step; ms += ms < 12 * step ? step : ms / 4)); do
    code=0
    timeout -s KILL "$(printf '%d.%03d' $((ms / 1000)) $((ms % 1000)))" "$@" >stdout 2>stderr </dev/null || code=$?
    [ "$code" != 0 ] || break
    [ "$code" = 137 ] || fail "killed, it ended with $code: $(<stderr)"
    kills=$((kills + 1))
  done
  [ "$code" = 0 ] || fail "not done after $kills kills"
  [ "$kills" -gt 0 ] || fail "no run was killed"
}

# A random moment in seconds, up to $1 milliseconds.
moment() {
  local ms=$((RANDOM % $1))
  printf '%d.%03d' $((ms / 1000)) $((ms % 1000))
}

# The good records of a journal from its first one on, a line each: end in bytes, point, CRC. A reader of its own, after the layout
# in lib/io/journal.hpp.
journal_records() {
  perl -e '
    my @table = map { my $c = $_; $c = $c & 1 ? $c >> 1 ^ 0xedb88320 : $c >> 1 for 1 .. 8; $c } 0 .. 255;
    sub crc { my $c = 0xffffffff; $c = $c >> 8 ^ $table[($c ^ $_) & 255] for unpack "C*", $_[0]; $c ^ 0xffffffff }
    open my $file, "<:raw", $ARGV[0] or exit;
    local $/;
    my $bytes = <$file> // "";
    my $at = 84;
    exit if length $bytes < $at || crc(substr $bytes, 0, 80) != unpack "V", substr $bytes, 80;
    while (length $bytes >= $at + 20) {
      my ($letters, $length, $point) = unpack "a4 V Q<", substr $bytes, $at;
      last if $letters ne "EPJR" || length $bytes < $at + 20 + $length;
      my $crc = unpack "V", substr $bytes, $at + 16 + $length, 4;
      last if $crc != crc(substr $bytes, $at, 16 + $length);
      $at += 20 + $length;
      print "$at $point $crc\n";
    }' "$1"
}
