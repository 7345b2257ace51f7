#!/bin/sh
# usage: photos_peer.sh PROGRAM PHOTOS   new photographs in two maps (recorded data), registered by hybridgv and by COLMAP on the same
# files: COLMAP goes on with what hybridgv writes, and both are compared with a reconstruction of all photographs. Skipped where COLMAP or the
# data are absent.
program=$1 photos=$2
if ! command -v colmap > /dev/null; then
  echo "COLMAP is missing (Debian package colmap): skipped"
  exit 77
fi
if [ ! -e "$photos/database.db" ]; then
  echo "no folder $photos: skipped"
  exit 77
fi
export QT_QPA_PLATFORM=offscreen
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
cp "$photos/database.db" "$scratch/database.db" && chmod u+w "$scratch/database.db" || fail "the database"
cd "$scratch" || exit 1

# For each photograph of the reference in the model as text: errors of the focal length [%] and of the position [% of the mean depth of the
# points that it sees].
errors() {
  awk -v map="$1" -v folder="$2" '
    function depth(X) { return 2 * (q1 * q3 - q0 * q2) * x[X] + 2 * (q2 * q3 + q0 * q1) * y[X] + (1 - 2 * (q1 * q1 + q2 * q2)) * z[X] + t3 }
    function centre(a, b, c, d, u, v, w) {  # -R^T t
      cx = -((1 - 2 * (c * c + d * d)) * u + 2 * (b * c + a * d) * v + 2 * (b * d - a * c) * w)
      cy = -(2 * (b * c - a * d) * u + (1 - 2 * (b * b + d * d)) * v + 2 * (c * d + a * b) * w)
      cz = -(2 * (b * d + a * c) * u + 2 * (c * d - a * b) * v + (1 - 2 * (b * b + c * c)) * w)
    }
    BEGIN {
      while ((getline line < (folder "/cameras.txt")) > 0) if (line !~ /^#/) { split(line, c, " "); focal[c[1]] = c[5] }
      while ((getline line < (folder "/points3D.txt")) > 0)
        if (line !~ /^#/) { split(line, c, " "); x[c[1]] = c[2]; y[c[1]] = c[3]; z[c[1]] = c[4] }
      while ((getline line < (folder "/images.txt")) > 0) if (line !~ /^#/ && line ~ /\.jpg$/) {
        split(line, c, " "); image[c[10]] = line; getline line < (folder "/images.txt"); seen[c[10]] = line
      }
    }
    $1 == map {
      if (!($2 in image)) { print "missing", $2; next }
      split(image[$2], c, " "); q0 = c[2]; q1 = c[3]; q2 = c[4]; q3 = c[5]; t3 = c[8]
      n = split(seen[$2], o, " "); sum = count = 0
      for (k = 3; k <= n; k += 3) if (o[k] in x) { sum += depth(o[k]); ++count }
      centre(q0, q1, q2, q3, c[6], c[7], t3); ux = cx; uy = cy; uz = cz
      centre($7, $8, $9, $10, $11, $12, $13)
      e = 100 * (focal[c[9]] / $5 - 1)
      print (e < 0 ? -e : e), 100 * sqrt((ux - cx) ^ 2 + (uy - cy) ^ 2 + (uz - cz) ^ 2) / (sum / count)
    }' "$photos/reference.txt"
}

for map in map0 map2; do
  for matches in two_view_geometries matches; do
    ours=${map}_$matches
    "$program" image_registrator --database_path database.db --input_path "$photos/$map" --output_path "$ours" --matches $matches --quiet ||
      fail "image_registrator: $map, $matches"
    colmap model_analyzer --path "$ours" > analysis 2>&1 || fail "model_analyzer: $(cat analysis)"
    # (One photograph, of which the reference says nothing, shares 12 points with the second map.)
    grep -Eq 'Registered images: (9|10)$' analysis || fail "the photographs are registered: $(cat analysis)"
    mkdir "${ours}_adjusted" "${ours}_text"
    colmap bundle_adjuster --input_path "$ours" --output_path "${ours}_adjusted" > log 2>&1 || fail "bundle_adjuster: $(tail -5 log)"
    colmap model_analyzer --path "${ours}_adjusted" > analysis 2>&1 || fail "model_analyzer after adjustment: $(cat analysis)"
    colmap model_converter --input_path "$ours" --output_path "${ours}_text" --output_type TXT > log 2>&1 || fail "model_converter: $(tail -3 log)"
    errors $map "${ours}_text" >> errors_$matches
  done
  mkdir ${map}_theirs ${map}_theirs_text
  colmap image_registrator --database_path database.db --input_path "$photos/$map" --output_path ${map}_theirs > log 2>&1 ||
    fail "COLMAP's image_registrator"
  colmap model_converter --input_path ${map}_theirs --output_path ${map}_theirs_text --output_type TXT > log 2>&1 || fail "model_converter"
  errors $map ${map}_theirs_text >> errors_theirs
done
median() { sort -n -k "$2" "errors_$1" | sed -n 4p | cut -d ' ' -f "$2"; }
for who in two_view_geometries matches theirs; do
  grep -q missing errors_$who && fail "registered by $who: $(cat errors_$who)"
  [ "$(wc -l < errors_$who)" = 7 ] || fail "seven photographs: $(cat errors_$who)"
done
theirs_focal=$(median theirs 1) theirs_position=$(median theirs 2)
echo "COLMAP: median error of the focal length $theirs_focal %, of the position $theirs_position % of the depth"
for who in two_view_geometries matches; do
  focal=$(median $who 1) position=$(median $who 2)
  echo "HybridGV, $who: $focal %, $position %"
  awk "BEGIN { exit !($focal <= 0.6 && $position <= 1.2 && 3 * $focal <= 2 * $theirs_focal && 3 * $position <= 2 * $theirs_position) }" ||
    fail "the errors: $(cat errors_$who)"
done
echo passed
