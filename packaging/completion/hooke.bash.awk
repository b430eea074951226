# Appends to hooke.bash what follows from the table of commands.
BEGIN { FS = "\t" }
$1 == "general" { general = $2 }
$1 == "scenes" { scenes = $2 }
$1 == "command" { commands = commands (commands == "" ? "" : " ") $2; name[++count] = $2 }
$1 == "option" {
  options[$2] = options[$2] (options[$2] == "" ? "" : " ") $3
  if ($4 == "flag" || $4 == "value") next
  action = $4 == "files" ? "_filedir" : $4 == "list" ? "_hooke_list '" $5 "'" : "COMPREPLY=($(compgen -W '" $5 "' -- \"$cur\"))"
  if (!(action in pattern)) actions[++action_count] = action
  words = split($3, word, " ")
  for (i = 1; i <= words; ++i)
    if (!((action, word[i]) in seen)) {
      seen[action, word[i]] = 1
      pattern[action] = pattern[action] (pattern[action] == "" ? "" : "|") word[i]
    }
}
END {
  print "_hooke_words() {\n  case $prev in"
  for (i = 1; i <= action_count; ++i)
    print "    " pattern[actions[i]] ") " actions[i] "; [[ ${COMPREPLY-} == *= ]] && compopt -o nospace; return ;;"
  print "  esac\n  local options\n  case ${words[1]} in"
  for (i = 1; i <= count; ++i) print "    " name[i] ") options='" options[name[i]] "' ;;"
  print "    *) options='" general " --from-desktop --reset-settings' ;;\n  esac"
  print "  case $cur in\n    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$cur\")); return ;;\n  esac\n  _filedir"
  print "  COMPREPLY+=($(compgen -W '" scenes "' -- \"$cur\"))"
  print "  [ \"$cword\" -gt 1 ] || COMPREPLY+=($(compgen -W '" commands "' -- \"$cur\"))\n}\ncomplete -F _hooke hooke hooke-headless"
}
