#!/bin/bash
# --help and -h of every script of a folder ($1) print how it is used, and do nothing else. In a copy, and without the programs by which a
# script that does not know them would install and build.
set -eu
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cp -r "$1" "$folder/scripts"
mkdir "$folder/programs"
for program in dirname sed; do ln -s "$(command -v $program)" "$folder/programs"; done
before=$(ls -R "$folder")

failed=0
for script in "$folder"/scripts/*; do
  [ -x "$script" ] || continue
  for option in --help -h; do
    code=0
    output=$(PATH="$folder/programs" "$script" $option 2>&1 </dev/null) || code=$?
    name=scripts/$(basename "$script")
    if [ "$code" != 0 ] || [[ $output != *"$name"* ]] || [[ $output == *"set -eu"* ]]; then
      echo "$name $option: exit code $code: $output" >&2
      failed=1
    fi
  done
done
if [ "$(ls -R "$folder")" != "$before" ]; then
  echo "--help has written files" >&2
  failed=1
fi
exit $failed
