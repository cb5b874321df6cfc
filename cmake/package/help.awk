# A tool's --help as a table: kind (option, argument, command), name, other name, type, values, description; by tabs.
BEGIN { OFS = "\t" }
function flush() {
  if (kind) print kind, name, other, type, values, text
  kind = ""
}
/^[A-Z][a-z]+:$/ { flush(); section = $1; next }
/^$/ { flush(); section = ""; next }
section == "" { next }
/^  [^ ]/ {
  flush()
  match($0, /[^ ]+( [^ ]+)*/)
  word = substr($0, RSTART, RLENGTH)
  text = substr($0, RSTART + RLENGTH)
  sub(/^ +/, "", text)
  kind = section == "Options:" ? "option" : section == "Subcommands:" ? "command" : "argument"
  split(word, words, " ")
  n = split(words[1], names, ",")
  name = names[n]
  other = n > 1 ? names[1] : ""
  type = words[2]
  values = match(word, /\{[^}]*\}/) ? substr(word, RSTART + 1, RLENGTH - 2) : ""
  sub(/[:=].*/, "", type)
  next
}
{ sub(/^ +/, ""); text = text (text ? " " : "") $0 }
END { flush() }
