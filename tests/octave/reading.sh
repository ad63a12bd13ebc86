#!/usr/bin/env bash
# reading.sh EPICYCLIC SOURCE_DIR
#
# The functions for Octave and MATLAB, in Octave: results of each kind, the same numbers as the CSV files have, figures and
# errors. The examples of docs/howto/use_from_octave.md run. Skipped (77) without Octave.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../cli/common.bash"
source "$here/../python/results.bash"
source_dir=$2

command -v octave-cli >/dev/null || skip "no Octave"
without_drawing
make_results
export PATH=$with_gnuplot  # Octave draws with it

# Octave without a display advises against gnuplot, with which it draws to files.
prelude="saved = warning('off', 'all'); graphics_toolkit('gnuplot'); figure('visible', 'off'); warning(saved);
  addpath('$source_dir/app/octave');"

# Each message of Octave on stderr is one too many, but for a missing display, a missing Ghostscript, what HDF5 says of a
# damaged file, and what Octave says as it ends.
octave_runs() {
  local code=0
  octave-cli --quiet --no-history --norc --eval "$prelude $1" >stdout 2>stderr || code=$?
  grep -v -e '^octave: X11' -e '^octave: disabling' -e 'ignoring const execution_exception' \
    -e "^warning: print: 'gs'" -e '^HDF5-DIAG' -e '^  #0' -e '^    m[ai][jn]or: ' stderr >messages || true
  [ "$code" = 0 ] && [ ! -s messages ] || fail "$2: exit $code: $(head -c 2000 messages)"
}
octave_runs "addpath('$source_dir/tests/octave'); reading" "the tests"
grep -q '^all read$' stdout || fail "the tests did not reach their end: $(tail -n 5 stdout)"

# What MATLAB does not know: Octave warns of it file by file.
octave-cli --quiet --no-history --norc --eval "warning('on', 'Octave:language-extension'); $prelude
  epicyclic.plot(epicyclic.open('out/speed'));" >stdout 2>stderr || fail "by the language of MATLAB: $(tail -n 3 stderr)"
! grep -F "$source_dir/app/octave" stderr || fail "words that only Octave knows"
grep -q 'language extension' stderr || fail "Octave does not warn of its own language"

blocks_of "$source_dir/docs/howto/use_from_octave.md" octave >page_example.m
[ "$(grep -c . page_example.m)" -ge 8 ] || fail "the page has no example"
octave_runs page_example "the examples of the page"
[ -s diagram.svg ] || fail "the page draws no diagram"
finish
