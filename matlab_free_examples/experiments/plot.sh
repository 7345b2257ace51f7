#!/bin/sh
# usage: plot.sh FOLDER [svg] [png]   draws the experiments' CSV files in the folder with gnuplot; the pictures go there too
folder=$1
shift
plots=$(dirname "$0")/plots
if ! command -v gnuplot >/dev/null; then
  echo "gnuplot is missing (Debian package gnuplot-nox): no pictures are drawn"
  exit 77
fi
drawn=0
for csv in "$folder"/*.csv; do
  plot=$plots/$(basename "$csv" .csv).gp
  [ -e "$plot" ] || continue
  for format in ${@:-svg png}; do
    gnuplot -e "folder = '$folder'; format = '$format'" "$plots/style.gp" "$plot" || exit 1
  done
  drawn=$((drawn + 1))
done
echo "$drawn CSV files drawn"
[ "$drawn" -gt 0 ]
