#!/bin/bash
# Tests the completions that file $1 of bash and, where fish is installed, file $2 of fish offer for some incomplete command lines.
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

fish=${2:+$(realpath "$2")}
cd "$(mktemp -d)" || exit 1
touch mine.json
expect convert hooke conv
expect drum_32 hooke drum
expect mine.json hooke min
expect --integrator hooke run cloth --integ
expect tr_bdf2 hooke run --integrator tr
expect substeps= hooke-headless run --set substep
expect off hooke run --set damped_springs=of
expect single hooke run cloth --precision s
expect mine.json hooke run cloth --csv mi
expect sweep hooke sw
expect substeps= hooke sweep rope --vary substep
expect --measure hooke sweep rope --mea
expect velocity_verlet,tr_bdf2 hooke bench --methods velocity_verlet,tr
expect tr_bdf2 hooke bench --methods=tr
expect per_strain hooke sweep rope --vary reading=per
expect plain,per_strain hooke sweep rope --vary reading=plain,per
expect cpu,fastest hooke sweep rope --measure cpu,fas
expect energy_hand hooke sweep rope --measure cpu,max:energy_ha

# expect_fish COMPLETION LINE
expect_fish() {
  offered=$(fish --no-config -c "source '$fish'; complete -C '$2'" | cut -f 1)
  [ "$offered" = "$1" ] && return
  echo "after \"$2\" fish offers \"$offered\" instead of \"$1\"" >&2
  exit 1
}

if command -v fish > /dev/null && [ -n "$fish" ]; then
  expect_fish velocity_verlet,tr_bdf2 'hooke bench --methods velocity_verlet,tr_'
  expect_fish reading=plain,per_strain 'hooke sweep rope --vary reading=plain,per'
  expect_fish cpu,max:energy_hand 'hooke sweep rope --measure cpu,max:energy_ha'
  expect_fish single 'hooke run cloth --precision s'
fi
rm -r "$PWD"
