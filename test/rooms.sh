#!/bin/sh
# The rooms of src/doc/developers.md: a folder of src/ includes itself, the public headers and folders that come before it in this
# list. Folders on one line do not include each other; src/ itself (.) holds what belongs to no folder.
cd "$(dirname "$0")/.." || exit 1
floors='
.
math/simd
math
math/roots math/dixon math/homotopy
correspondences
solvers
solvers/complex_rays
solvers/three_points solvers/one_centre solvers/h32f solvers/h51f solvers/h70f solvers/known_focal
robust/kernels
robust
hybrid_pose
absolute_pose relative_pose sac sac_problems/hybrid_pose
program/common
program
'
# One line for each include of a file of ours: the folder and file that includes, the folder and file that is included.
includes() {
  find src -name '*.[ch]pp' | sort | while read -r file; do
    folder=$(dirname "${file#src/}")
    [ "$file" = src/types.cpp ] && continue  # public functions on the table of solvers, beside no folder of their own
    sed -n 's/^#include "\(.*\)"$/\1/p' "$file" | while read -r header; do
      if [ -e "src/$header" ]; then
        echo "$folder $file $(dirname "$header") $header"
      elif [ -e "$(dirname "$file")/$header" ]; then
        echo "$folder $file $folder $header"
      else
        case "$header" in hybridgv/*) ;; *) echo "$folder $file nowhere $header" ;; esac
      fi
    done
  done
}
includes | awk -v floors="$floors" '
  BEGIN {
    count = split(floors, lines, "\n")
    for (i = 1; i <= count; ++i) {
      rooms = split(lines[i], names, " ")
      for (k = 1; k <= rooms; ++k) floor[names[k]] = i
    }
  }
  !($1 in floor) { print $2 ": the folder " $1 " is in no list of test/rooms.sh"; bad = 1; next }
  $1 != $3 && (!($3 in floor) || floor[$3] >= floor[$1]) { print $2 " includes " $4 ", which is not below it"; bad = 1 }
  END { print NR " includes"; exit bad || NR == 0 }
'
