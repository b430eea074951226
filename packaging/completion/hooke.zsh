#compdef hooke hooke-headless

# Of values that are separated by commas, the last one; after NAME=VALUE, other values of this name.
_hooke_list() {
  local -a words=("$@")
  [[ $PREFIX != *=*,* ]] || words=(${${(M)words:#${PREFIX%%=*}=*}#*=})
  compset -P '*,'
  compadd -S '' -- $words
}

