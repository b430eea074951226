# Appends to hooke.zsh what follows from the table of commands.
BEGIN { FS = "\t" }
# In single quotes, with a backslash before these characters.
function quoted(text, characters) {
  gsub(characters, "\\\\&", text)
  gsub("'", "'\\''", text)
  return "'" text "'"
}
$1 == "scenes" { scenes = $2 }
$1 == "command" { described = described "\n    " quoted($2 ":" $3, "\n"); name[++count] = $2 }
$1 == "option" {
  value = $4 == "flag" ? "" : ":value:" ($4 == "files" ? "_files" : $4 == "value" ? " " : $4 == "words" ? "(" $5 ")" : "")
  if ($4 == "list") {
    listed = $5
    gsub(":", "\\:", listed)
    value = value " _hooke_list " listed
  }
  words = split($3, word, " ")
  for (i = 1; i <= words; ++i)
    options[$2] = options[$2] " \\\n      " quoted("*" word[i] (value != "" && word[i] ~ /^--/ ? "=" : "") "[", "\n") quoted($6, "[][\\\\:]") quoted("]" value, "\n")
}
END {
  print "_hooke_scenes() {\n  _alternative 'scenes:scene:(" scenes ")' 'files:file:_files'\n}"
  print "_hooke() {\n  local -a commands=(" described "\n  )"
  print "  if (( CURRENT == 2 )); then\n    _describe command commands\n    _hooke_scenes\n    return\n  fi"
  print "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in"
  for (i = 1; i <= count; ++i) print "    " name[i] ") _arguments -S" options[name[i]] " \\\n      '*:scene:_hooke_scenes' ;;"
  print "    *) _files ;;\n  esac\n}\n_hooke \"$@\""
}
