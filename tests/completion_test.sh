#!/bin/bash
# Tests the completions that file $1 offers for some incomplete command lines.
. /usr/share/bash-completion/bash_completion
. "$1"

# expect COMPLETIONS WORDS...: the last word is being typed
expect() {
  offered=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_POINT=$(expr length "$*") COMPREPLY=()
  _hooke 2>/dev/null
  [ "${COMPREPLY[*]}" = "$offered" ] && return
  echo "after \"$*\" the completion offers \"${COMPREPLY[*]}\" instead of \"$offered\"" >&2
  exit 1
}

cd "$(mktemp -d)" || exit 1
touch mine.json
expect convert hooke conv
expect drum_32 hooke drum
expect mine.json hooke mi
expect --integrator hooke run cloth --integ
expect tr_bdf2 hooke run --integrator tr
expect substeps= hooke-headless run --set substep
expect damped_springs=off hooke run --set damped_springs=of
expect single hooke run cloth --precision s
expect mine.json hooke run cloth --csv mi
expect sweep hooke sw
expect substeps= hooke sweep rope --vary substep
expect --measure hooke sweep rope --mea
rm -r "$PWD"
