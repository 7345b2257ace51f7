# The rows of real_photos.csv as a table to read, in Markdown.
function number(value) { return value == "inf" ? "-" : sprintf(value < 0.1 ? "%.3f" : "%.2f", value) }
function both(column) { return number($column) " (" number($(column + 1)) ")" }
BEGIN {
  FS = ","
  print "| map | method | registered, within 1 deg and 5 % | focal length %, median (90 %) | rotation deg | position % of the depth | focal error / deviation, median (below 2) | ms per image |"
  print "|---|---|---|---|---|---|---|---|"
}
/^#/ || /^set,/ { next }
{
  map = $1 " " $2
  method = $3
  sub(/;/, ",", method)
  if (method ~ /registrator/) method = "`" method "`"
  honesty = $13 == "" ? "" : number($13) " (" sprintf("%.0f %%", $14) ")"
  printf "| %s | %s | %.0f %%, %.0f %% | %s | %s | %s | %s | %s |\n", map == last ? "" : map, method, $5, $6, both(7), both(9), both(11), honesty, $15 < 10 ? number($15) : sprintf("%.0f", $15)
  last = map
}
