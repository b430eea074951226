# bash completion of hooke and hooke-headless

# Of values that are separated by commas, the last one; after NAME=VALUE, other values of this name.
_hooke_list() {
  local start=${cur%"${cur##*,}"} word words=$1
  if [[ $start == *=* ]]; then
    words=
    for word in $1; do [[ $word != "${cur%%=*}="* ]] || words+=" ${word#*=}"; done
  fi
  COMPREPLY=($(compgen -P "$start" -W "$words" -- "${cur##*,}"))
  compopt -o nospace
}

_hooke() {
  local cur prev words cword
  _init_completion -n =: || return
  # to readline, what precedes the last of these is a word of its own
  local before=${cur%"${cur##*[=:]}"}
  if [[ $cur == --*=* ]]; then prev=${cur%%=*} cur=${cur#*=} before=${before#*=}; fi
  _hooke_words
  COMPREPLY=("${COMPREPLY[@]#"$before"}")
}

