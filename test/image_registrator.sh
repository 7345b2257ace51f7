#!/bin/sh
# usage: image_registrator.sh PROGRAM MAKE_DATABASE   hybridgv image_registrator on a database and a map without images
program=$1
tests=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
"$2" "$scratch" 8 || fail "the database"
cd "$scratch" || exit 1
register() { "$program" image_registrator --database_path database.db --input_path map "$@"; }
cp -r map original

register --output_path new/out --results_path poses.txt --json_path out.jsonl > table 2> summary || fail "all images"
grep -q 'registered 8 of 8 images' summary || fail "the summary: $(cat summary)"
[ "$(grep -c '^photo_' table)" = 8 ] || fail "a row for each image"
awk 'length > 100 { print; bad = 1 } END { exit bad }' table || fail "the table is wider than 100 columns"
[ "$(wc -l < poses.txt)" = 8 ] || fail "a pose for each image"
[ "$(grep -c '"schema":"hybridgv/localization/1","query":"photo_[0-9]*.jpg","success":true' out.jsonl)" = 8 ] || fail "an object for each image"
schema=$(cd "$tests/../src/doc" && pwd)/localization.schema.json
if python3 -c 'import jsonschema' 2> /dev/null; then
  python3 -c 'import json, jsonschema, sys
schema = json.load(open(sys.argv[1]))
for line in open(sys.argv[2]): jsonschema.validate(json.loads(line), schema)' "$schema" out.jsonl || fail "the objects are not what the schema says"
else
  echo "python3-jsonschema is missing: the JSON lines are not compared with their schema"
fi
# Focal lengths and poses are right.
awk 'NR == FNR { f[$1] = $2; next } { e = 100 * ($2 / f[$1] - 1); if (e > 1 || e < -1) { print $1, $2, f[$1]; bad = 1 } } END { exit bad }' \
  truth.txt table || fail "a focal length is wrong by more than 1 %"
awk 'NR == FNR { for (i = 4; i <= 7; ++i) q[$1, i] = $i; next }
  { d = 0; for (i = 4; i <= 7; ++i) d += q[$1, i] * $(i - 2); if (d * d < 0.99998) { print; bad = 1 } } END { exit bad }' \
  truth.txt poses.txt || fail "a rotation is wrong"
for file in cameras images points3D; do cmp "map/$file.bin" "original/$file.bin" || fail "the input was changed"; done

# A page alone is an output too; an image that fails is on it with the reason.
register --html_path page.html --ply_path map.ply --Mapper.abs_pose_min_num_inliers 100000 --quiet || fail "a page"
[ "$(grep -o '"success":false,"reason":"[^"]*100000' page.html | wc -l)" = 8 ] || fail "a page: $(grep -o '"reason":"[^"]*"' page.html)"
head -1 map.ply | grep -q '^ply$' || fail "a point cloud"
register --html_path page.html --image_path nowhere 2> error
[ $? = 2 ] && grep -q 'is no folder' error || fail "a folder of images that is not there: $(cat error)"

# What is there already is skipped; the output may be the input.
cp -r new/out again
"$program" image_registrator --database_path database.db --input_path again --output_path again > table 2> summary || fail "again"
grep -q 'registered 0 of 0 images' summary || fail "nothing is left: $(cat summary)"
for file in cameras images points3D; do cmp "again/$file.bin" "new/out/$file.bin" || fail "nothing new, but other bytes"; done

# The number of threads does not matter, nor whether one runs in two parts.
for threads in 1 3; do
  register --output_path "threads$threads" --Mapper.num_threads $threads --quiet > table 2> summary || fail "$threads threads"
  [ ! -s table ] && [ ! -s summary ] || fail "--quiet"
  for file in cameras images points3D; do cmp "threads$threads/$file.bin" "new/out/$file.bin" || fail "$threads threads"; done
done
printf 'photo_12.jpg \r\n\nphoto_15.jpg\nphoto_12.jpg\nphoto_3.jpg\n' > list
register --output_path part --image_list_path list > table 2> summary || fail "a list"
grep -q 'registered 2 of 2 images; 1 more are in the map already' summary || fail "a list: $(cat summary)"
register --output_path part --image_list_path - < list > table 2> /dev/null || fail "a list from the standard input"
[ "$(grep -c '^photo_' table)" = 2 ] || fail "a list from the standard input"

# Several new images of one camera have it in common, and it is right.
mkdir shared && "$2" shared 6 10 1500 shared || fail "the database of one camera"
"$program" image_registrator --database_path shared/database.db --input_path shared/map --output_path shared/text --output_type TXT \
  > table 2> summary || fail "one camera"
grep -q 'registered 6 of 6' summary || fail "one camera: $(cat summary)"
[ "$(grep -vc '^#' shared/text/cameras.txt)" = 11 ] || fail "one camera for six new images: $(cat shared/text/cameras.txt)"
awk 'NR == FNR { f = $2; k = $3; next } $1 == 11 { e = $5 / f - 1; d = $8 - k; good = e * e < 1e-6 && d * d < 1e-4 } END { exit !good }' \
  shared/truth.txt shared/text/cameras.txt || fail "the common camera is $(grep '^11 ' shared/text/cameras.txt), truth: $(head -1 shared/truth.txt)"

# Interrupted: what was registered until then is written, and the next run does the rest.
timeout -s INT 0.02 "$program" image_registrator --database_path database.db --input_path map --output_path stopped --quiet
code=$?
if [ -e stopped/images.bin ]; then
  "$program" image_registrator --database_path database.db --input_path stopped --output_path stopped --quiet || fail "continued"
  [ "$(wc -c < stopped/images.bin)" = "$(wc -c < new/out/images.bin)" ] || fail "interrupted ($code) and continued"
fi

# Text.
register --output_path text --output_type TXT --quiet || fail "text"
grep -q 'photo_18.jpg' text/images.txt || fail "text"
register --output_path new/out --output_type TXT 2> error
[ $? = 2 ] && grep -q 'would hide' error || fail "text beside a binary model"

# A camera whose model is newer than this program keeps its line, its image keeps its two lines, and both stay in the points' tracks.
register --output_path tomorrow --output_type TXT --Mapper.abs_pose_min_num_inliers 100000 --quiet || fail "the map as text"
sed 's/^\([0-9]*\) [A-Z_]* \(.*\)/\1 OPENCV_OF_TOMORROW \2 0.10000000000000001 -3/; 4,$d' tomorrow/cameras.txt > changed
sed 1,3d tomorrow/cameras.txt >> changed && mv changed tomorrow/cameras.txt
cp -r tomorrow today
[ "$(grep -c OPENCV_OF_TOMORROW today/cameras.txt)" = 2 ] || fail "two cameras of tomorrow: $(cat today/cameras.txt)"
"$program" image_registrator --database_path database.db --input_path tomorrow --output_path tomorrow --output_type TXT > table 2> summary ||
  fail "a map with cameras of tomorrow"
grep -q 'registered 8 of 10' summary || fail "a map with cameras of tomorrow: $(cat summary)"
sed 's/0.10000000000000001/0.1/' today/cameras.txt | grep OPENCV_OF_TOMORROW > before
grep OPENCV_OF_TOMORROW tomorrow/cameras.txt | cmp - before || fail "cameras of tomorrow"
for camera in $(cut -d ' ' -f 1 before); do
  for when in today tomorrow; do awk -v c=$camera 'NF == 10 && $9 == c { shown = 2 } shown-- > 0' $when/images.txt > images_$when; done
  [ "$(wc -l < images_today)" = 2 ] && cmp images_today images_tomorrow || fail "images of camera $camera"
done
awk 'NR == FNR { line[$1] = $0; next } $1 in line && index($0, line[$1]) != 1 { print; bad = 1 } END { exit bad }' today/points3D.txt tomorrow/points3D.txt ||
  fail "tracks are continued, the rest of the points is as it was"

# COLMAP's options, and its project files.
register --output_path options --Mapper.ba_refine_focal_length 1 --log_to_stderr=1 --Mapper.tri_min_angle 2 > table 2> summary || fail "options of COLMAP"
[ "$(grep -c 'not used: ' summary)" = 3 ] || fail "options that mean nothing: $(cat summary)"
cat > project.ini << END
# a comment
log_to_stderr=false
database_path=database.db
input_path = map
output_path=elsewhere
[SiftExtraction]
num_threads=4
[Mapper]
min_num_matches=15
abs_pose_min_num_inliers = 100000
END
"$program" image_registrator --project_path project.ini --output_path project > table 2> summary || fail "a project file"
grep -q 'registered 0 of 8' summary && grep -q '8 not registered, too few inliers: photo_11.jpg' summary || fail "a project file: $(cat summary)"
[ ! -e elsewhere ] && [ -e project/images.bin ] || fail "the command line counts"
"$program" image_registrator --project_path project.ini --require_all 1 > table 2> summary
[ $? = 3 ] || fail "--require_all"

expect_error() {
  code=$1 message=$2 && shift 2
  "$program" image_registrator "$@" > out 2> error
  found=$?
  [ $found = "$code" ] || fail "$* must exit with $code, not $found"
  grep -q -- "$message" error || fail "$* must say $message: $(cat error)"
  [ ! -s out ] || fail "nothing on the standard output before an error: $(cat out)"
}
expect_error 2 "--output_path is required" --database_path database.db --input_path map
expect_error 2 "database_path" --input_path map --output_path x
expect_error 2 "nonsense" --database_path database.db --input_path map --output_path x --Mapper.nonsense 1
expect_error 2 "must be 0 or 1" --database_path database.db --input_path map --output_path x --radial 2
expect_error 2 "min_num_matches: must be" --database_path database.db --input_path map --output_path x --Mapper.min_num_matches -1
expect_error 1 "missing.db: no such file" --database_path missing.db --input_path map --output_path x
expect_error 1 "missing: no such file" --database_path database.db --input_path missing --output_path x
expect_error 1 "no SQLite database" --database_path truth.txt --input_path map --output_path x
echo nobody.jpg > list
expect_error 1 'has no image "nobody.jpg"' --database_path database.db --input_path map --output_path x --image_list_path list
[ ! -e x ] || fail "an error leaves no folder"
"$program" nonsense 2> error && fail "an unknown command"
grep -q 'no command "nonsense"' error || fail "an unknown command: $(cat error)"
for command in image_registrator localize; do "$program" $command --help | grep -q '^Usage: hybridgv' || fail "help of $command"; done
"$program" --version | grep -q '^hybridgv [0-9]' || fail "--version"

# Whoever is killed in the middle of writing leaves the old model or the new one.
cp -r map killed
for delay in 0.005 0.01 0.015 0.02 0.025 0.03 0.04 0.05 0.06 0.08 0.1; do
  rm -r killed && cp -r map killed
  timeout -s KILL $delay "$program" image_registrator --database_path database.db --input_path killed --output_path killed --quiet
  for state in map new/out; do
    same=yes
    for file in cameras images points3D; do cmp -s "killed/$file.bin" "$state/$file.bin" || same=no; done
    [ $same = no ] || break
  done
  [ $same = yes ] || fail "killed after $delay s: neither the old model nor the new one"
done

# Results that cannot be written are no success.
if [ -w /dev/full ]; then
  register --json_path - > /dev/full 2> error && fail "written to a full device"
  grep -q "cannot write" error || fail "the message about a full device: $(cat error)"
fi
echo passed
