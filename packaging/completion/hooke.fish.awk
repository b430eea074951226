# Appends to hooke.fish what follows from the table of commands.
BEGIN { FS = "\t" }
function quoted(text) {
  gsub("'", "'\\''", text)
  return "'" text "'"
}
function complete_with(rest) { print "complete -c hooke " rest "\ncomplete -c hooke-headless " rest }
$1 == "scenes" { scenes = $2 }
$1 == "command" { complete_with("-n __fish_use_subcommand -a " $2 " -d " quoted($3)) }
$1 == "option" {
  rest = "-n '__fish_seen_subcommand_from " $2 "'"
  words = split($3, word, " ")
  for (i = 1; i <= words; ++i) rest = rest (word[i] ~ /^--/ ? " -l " substr(word[i], 3) : " -s " substr(word[i], 2))
  if ($4 == "files") rest = rest " -r"
  else if ($4 != "flag") rest = rest " -x"
  if ($4 == "words") rest = rest " -a " quoted($5)
  if ($4 == "list") rest = rest " -a " quoted("(__hooke_list " $5 ")")
  complete_with(rest " -d " quoted($6))
}
END { complete_with("-a " quoted(scenes)) }
