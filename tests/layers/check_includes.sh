#!/usr/bin/env bash
# check_includes.sh SOURCE_DIR LAYER
#
# Fails, with a line for each offence, when a file of the layer (lib/LAYER, or app) includes a layer that it must not
# know, a header by a path with .., a header in a folder that is no layer, or SUNDIALS outside integrate/sundials. Headers
# of the own folder may be written without it.
set -euo pipefail

source_dir=$1
layer=$2

layers=(core gear model integrate analysis studies figures store input reports kinds claims)
case $layer in
  core) allowed=(core) ;;
  gear) allowed=(gear core) ;;
  model) allowed=(model gear core) ;;
  integrate) allowed=(integrate core) ;;
  analysis) allowed=(analysis integrate core) ;;
  studies) allowed=(studies model gear analysis integrate core) ;;
  figures) allowed=(figures core) ;;
  store) allowed=(store studies model gear analysis integrate core) ;;
  input) allowed=(input studies model gear analysis integrate core) ;;
  reports) allowed=(reports input store figures studies model gear analysis integrate core) ;;
  kinds) allowed=(kinds reports input store figures studies model gear analysis integrate core) ;;
  claims) allowed=(claims kinds reports input store figures studies model gear analysis integrate core) ;;
  app) allowed=(kinds reports input store figures studies core) ;; # no numerics in the command
  *)
    echo "no such layer: $layer" >&2
    exit 2
    ;;
esac

folder=$source_dir/lib/$layer
[ "$layer" != app ] || folder=$source_dir/app
if [ ! -d "$source_dir/lib" ]; then
  echo "no source folder: $source_dir" >&2
  exit 2
fi
if [ ! -d "$folder" ]; then exit 0; fi # git keeps no folder for a layer without files

contains() {
  local wanted=$1 item
  shift
  for item in "$@"; do
    if [ "$item" = "$wanted" ]; then return 0; fi
  done
  return 1
}

offences=0
offence() {
  echo "$1: $2"
  offences=$((offences + 1))
}

# file:line:#include "x" or <x>; spaces are allowed wherever the preprocessor allows them.
while IFS= read -r hit; do
  place=${hit%%:#*}
  style=${hit#*#*include}
  style=${style#"${style%%[![:space:]]*}"}
  included=${style:1}
  included=${included%%[\">]*}
  style=${style:0:1}

  # What users write, and what a layer could write to slip past: the same header.
  path=${included#epicyclic/}
  first=${path%%/*}

  if [[ $included =~ ^(arkode|cvode|cvodes|ida|idas|kinsol|nvector|sundials|sun[a-z]+)/ ]] &&
    ! contains "$first" "${layers[@]}"; then
    [[ $place = "$source_dir"/lib/integrate/sundials/* ]] ||
      offence "$place" "SUNDIALS belongs to integrate/sundials: $included"
  elif [[ /$included/ == */../* ]]; then
    offence "$place" "a path with ..: $included"
  elif [[ $path != */* ]] || { [ "$style" = '"' ] && { [ -e "$folder/$path" ] || [ -e "$folder/command/$path" ]; }; }; then
    : # a standard header or one of the own folder
  elif contains "$first" "${layers[@]}"; then
    # Claims are optional; Python has the equations of motion, and systems of its own.
    contains "$first" "${allowed[@]}" || [[ $first = claims && $place = "$source_dir"/app/command/claims/* ]] ||
      [[ $first =~ ^(gear|model|analysis|integrate)$ && $place = "$source_dir"/app/binding/* ]] ||
      offence "$place" "$layer must not include $first: $included"
  elif [ "$style" = '"' ] && [ "$first" != "$layer" ]; then
    offence "$place" "no such layer: $included"
  fi
done < <(find "$folder" -type f \( -name '*.[hci]pp' -o -name '*.[hc]' -o -name '*.inc' -o -name '*.in' \) -print0 |
  xargs -0 -r grep -nHE '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<]' |
  sed -E 's/^([^:]*:[0-9]+:)[[:space:]]*#/\1#/')

if [ $offences -gt 0 ]; then
  echo "$layer: $offences forbidden includes (allowed: ${allowed[*]})"
  exit 1
fi
