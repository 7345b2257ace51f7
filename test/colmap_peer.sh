#!/bin/sh
# usage: colmap_peer.sh PROGRAM MAKE_DATABASE   COLMAP itself goes on with what hybridgv image_registrator writes, and is compared with it
# on the same database. Skipped where COLMAP is not installed.
program=$1
if ! command -v colmap > /dev/null; then
  echo "COLMAP is missing (Debian package colmap): skipped"
  exit 77
fi
export QT_QPA_PLATFORM=offscreen
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
"$2" "$scratch" 12 || fail "the database"
cd "$scratch" || exit 1
mkdir theirs adjusted theirs_text ours_text adjusted_text

"$program" image_registrator --database_path database.db --input_path map --output_path ours --quiet || fail "image_registrator"
colmap image_registrator --database_path database.db --input_path map --output_path theirs > log 2>&1 || fail "COLMAP's image_registrator"
colmap model_analyzer --path ours > analysis 2>&1 || fail "model_analyzer: $(cat analysis)"
grep -Eq 'Registered images: 22$' analysis || fail "all images are registered: $(cat analysis)"
colmap bundle_adjuster --input_path ours --output_path adjusted > adjustment 2>&1 || fail "bundle_adjuster: $(tail -5 adjustment)"
# COLMAP registers images in our model (none is left), and triangulates more points with them.
mkdir again && colmap image_registrator --database_path database.db --input_path ours --output_path again > log 2>&1 || fail "again"
for model in ours theirs adjusted; do
  colmap model_converter --input_path $model --output_path ${model}_text --output_type TXT > log 2>&1 || fail "model_converter: $(tail -3 log)"
done

# The median error [%] of the focal lengths of the images that were registered.
median_error() {
  awk -v folder="$1" '
    BEGIN {
      while ((getline line < (folder "/cameras.txt")) > 0) if (line !~ /^#/) { split(line, c, " "); focal[c[1]] = c[5] }
      while ((getline line < (folder "/images.txt")) > 0) if (line ~ /\.jpg$/) { n = split(line, i, " "); camera[i[n]] = i[n - 1] }
    }
    { e = 100 * (focal[camera[$1]] / $2 - 1); print e < 0 ? -e : e }' truth.txt | sort -n | sed -n 6p
}
ours=$(median_error ours_text) theirs=$(median_error theirs_text) adjusted=$(median_error adjusted_text)
echo "median error of the focal length: HybridGV $ours %, after bundle adjustment $adjusted %, COLMAP $theirs %"
awk "BEGIN { exit !($ours < 0.3 && $ours < $theirs && $adjusted < 0.3) }" || fail "the errors"
echo passed
