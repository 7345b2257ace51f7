# What Doxygen reads in place of the files; lines keep their numbers.
#
# Pages: formulas, $..$ within a line and ```math .. ``` over several, become Doxygen's. Headings get the names that GitHub gives them, so
# that links to them work here too; links to files that are not part of the site become text. Text in other code blocks and between
# backquotes stays as it is.
# Headers: defaulted members are left out, they need no comment.
function inlineFormulas(line,    count, result, inCode, inFormula, j, character) {
  count = length(line)
  for (j = 1; j <= count; ++j) {
    character = substr(line, j, 1)
    if (character == "`" && !inFormula) inCode = !inCode
    if (character == "$" && !inCode) {
      inFormula = !inFormula
      result = result "\\f$"
    } else {
      result = result character
    }
  }
  return inFormula ? result "\\formulaIsNotClosedOnItsLine" : result
}
# The folder and the name of a page, which tell all pages apart: doc_faq for src/doc/faq.md.
function pageOf(path,    parts, count) {
  count = split(path, parts, "/")
  sub(/\.md$/, "", parts[count])
  return (count > 1 ? parts[count - 1] : here) "_" parts[count]
}
# GitHub's name of a heading.
function nameOf(heading) {
  heading = tolower(heading)
  gsub(/[^a-z0-9 _-]/, "", heading)
  gsub(/ /, "-", heading)
  return heading
}
# The address of a link as it must be for Doxygen; "" if there is nothing on the site to link to.
function addressOf(address,    hash, path) {
  if (address ~ /^https?:/) return address
  hash = index(address, "#")
  path = hash ? substr(address, 1, hash - 1) : address
  if (path ~ /\.(svg|png)$/) return address
  if (path != "" && path !~ /\.md$/) return ""
  if (path ~ /(^|\/)\.\.\/README\.md$/) return ""
  return hash ? "@ref " (path == "" ? page : pageOf(path)) "-" substr(address, hash + 1) : address
}
function siteLinks(line,    result, start, text, address) {
  while (match(line, /\]\([^()]*\)/)) {
    address = addressOf(substr(line, RSTART + 2, RLENGTH - 3))
    text = substr(line, 1, RSTART - 1)
    start = length(text)
    while (start > 0 && substr(text, start, 1) != "[") --start
    if (address == "" && start > 0)
      result = result substr(text, 1, start - 1) substr(text, start + 1)
    else
      result = result text "](" (address == "" ? substr(line, RSTART + 2, RLENGTH - 3) : address) ")"
    line = substr(line, RSTART + RLENGTH)
  }
  return result line
}
FILENAME ~ /\.hpp$/ { print / = default;$/ ? "" : $0; next }
FNR == 1 { here = "doc"; page = pageOf(FILENAME); here = page; sub(/_.*/, "", here) }
/^ *```math *$/ { display = 1; print "\\f["; next }
/^ *``` *$/ && display { display = 0; print "\\f]"; next }
/^ *```/ { code = !code; print; next }
display || code || /^    / { print; next }
/^##+ / {
  heading = $0
  sub(/^#+ /, "", heading)
  print inlineFormulas(siteLinks($0)) " {#" page "-" nameOf(heading) "}"
  next
}
{ print inlineFormulas(siteLinks($0)) }
