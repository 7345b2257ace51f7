# What Doxygen reads in place of the files; lines keep their numbers.
#
# Pages: formulas, $..$ within a line and ```math .. ``` over several, become Doxygen's. Text in other code blocks and between
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
FILENAME ~ /\.hpp$/ { print / = default;$/ ? "" : $0; next }
/^ *```math *$/ { display = 1; print "\\f["; next }
/^ *``` *$/ && display { display = 0; print "\\f]"; next }
/^ *```/ { code = !code; print; next }
display || code { print; next }
{ print inlineFormulas($0) }
