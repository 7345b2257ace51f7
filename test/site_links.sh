#!/bin/sh
# usage: site_links.sh FOLDER   every link on the pages of the documentation site in this folder leads to a page and to a place on it. (Doxygen
# lets links to unknown places pass.)
cd "$1" || exit 1
awk '
  FNR == 1 { exists[FILENAME] = 1 }
  {
    line = $0
    while (match(line, /(id|name)="[^"]*"/)) {
      place = substr(line, RSTART, RLENGTH - 1)
      sub(/^[a-z]*="/, "", place)
      places[FILENAME "#" place] = 1
      line = substr(line, RSTART + RLENGTH)
    }
    if (FILENAME !~ /^(index|md_)/) next
    line = $0
    while (match(line, /href="[^"]*"/)) {
      links[FILENAME " " substr(line, RSTART + 6, RLENGTH - 7)] = 1
      line = substr(line, RSTART + RLENGTH)
    }
  }
  END {
    for (link in links) {
      page = target = link
      sub(/ .*/, "", page)
      sub(/^[^ ]* /, "", target)
      if (target ~ /^(https?|file|javascript):/ || target ~ /\.(css|js|svg|png)$/) continue
      if (target ~ /^#/) target = page target
      file = target
      sub(/#.*/, "", file)
      ++count
      if ((file in exists) && (target !~ /#/ || (target in places))) continue
      print page ": " target " leads nowhere"
      ++faults
    }
    print count " links, " faults + 0 " lead nowhere"
    exit faults > 0
  }' *.html
