# The tables of help.awk, each line after the name of its command (empty: the tool's own), as completion for -v shell=bash
# or zsh of -v tool.
BEGIN { FS = "\t"; function_name = "_" tool; gsub(/-/, "_", function_name) }
$2 == "command" { commands = commands " " $3; about[$3] = $7 }
$2 == "option" {
  if (!($1 in flags)) order[++count] = $1
  flags[$1] = flags[$1] " " $3 ($4 ? " " $4 : "")
  names = $4 ? $4 "|" $3 : $3
  gsub(/,/, " ", $6)
  if ($6) cases[$1] = cases[$1] "        " names ") COMPREPLY=($(compgen -W \"" $6 "\" -- \"$word\")); return ;;\n"
  else if ($5) cases[$1] = cases[$1] "        " names ") return ;;\n"
  specs[$1] = specs[$1] " \\\n      " zshSpec()
}
function quoted(text) {
  gsub(/'/, "'\\''", text)
  gsub(/[\[\]:]/, "\\\\&", text)
  return text
}
function zshSpec(    rest) {
  rest = "'[" quoted($7) "]"
  if ($5) rest = rest ":" tolower($5) ":" ($6 ? "(" $6 ")" : $5 == "DIR" ? "_files -/" : "_files")
  return $4 ? "'(" $4 " " $3 ")'{" $4 "," $3 "}" rest "'" : "'" $3 "'" rest "'"
}
function findCommand() {
  return "for candidate in " (shell == "bash" ? "\"${COMP_WORDS[@]:1:COMP_CWORD-1}\"" : "\"${(@)words[2,CURRENT-1]}\"") "; do\n" \
    "    case $candidate in " substr(alternatives, 2) ") command=$candidate; break ;; esac\n  done\n"
}
END {
  alternatives = commands
  gsub(/ /, "|", alternatives)
  if (shell == "bash") {
    print function_name "() {"
    print "  local word=$2 previous=$3 command= candidate options"
    if (commands) printf "  %s", findCommand()
    print "  case $command in"
    for (i = 1; i <= count; ++i) {
      c = order[i]
      print "    " (c ? c : "\"\"") ")"
      print "      case $previous in\n" cases[c] "      esac"
      print "      options=\"" substr(flags[c], 2) "\"\n      ;;"
    }
    print "  esac"
    print "  if [[ $word == -* ]]; then\n    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))"
    if (commands) print "  elif [ -z \"$command\" ]; then\n    COMPREPLY=($(compgen -W \"" substr(commands, 2) "\" -- \"$word\"))"
    print "  fi\n}\ncomplete -o default -F " function_name " " tool
  } else {
    print "#compdef " tool
    print "local command= candidate"
    if (commands) {
      print "local -a commands=("
      n = split(substr(commands, 2), list, " ")
      for (i = 1; i <= n; ++i) print "  '" list[i] ":" quoted(about[list[i]]) "'"
      printf ")\n%s", findCommand()
    }
    print "case $command in"
    for (i = 1; i <= count; ++i) {
      c = order[i]
      print "  " (c ? c : "\"\"") ")\n    _arguments" specs[c] " \\\n      " \
        (c == "" && commands ? "'*: :{ _describe command commands; _files }'" : "'*:file:_files'") " ;;"
    }
    print "esac"
  }
}
