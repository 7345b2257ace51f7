#!/bin/sh
# usage: real_photos.sh BUILD MAKE_DATABASE REALDATA   the experiment on real images, on a database of our own, and on REALDATA/photos where
# there is such a folder
build=$1 make_database=$2 realdata=$3
script=$(cd "$(dirname "$0")/.." && pwd)/matlab_free_examples/experiments/real_photos.sh
program=$build/matlab_free_examples/experiments/real_photos
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
cd "$scratch" || exit 1

# value MAP METHOD COLUMN: of the table in the folder `results`
value() { awk -F, -v map="$1" -v method="$2" -v column="$3" '$2 == map && $3 == method { print $column }' results/real_photos.csv; }
# expect CONDITION: with awk's arithmetic
expect() { awk "BEGIN { exit !($1) }" || fail "$1: $(cat results/real_photos.csv)"; }
registered=5 within=6 focal=7 position=11

# Our own database; lenses and poses are known.
mkdir own && "$make_database" "$scratch/own" 8 || fail "the database"
awk '{ print "map", $1, 1600, 1200, $2, $3, $4, $5, $6, $7, $8, $9, $10 }' own/truth.txt > own/reference.txt
sh "$script" --work results --build "$build" --prepared own > log 2>&1 || fail "the script: $(cat log)"
for method in "hybrid; verified matches" "hybrid; raw matches" "hybridgv image_registrator"; do
  [ "$(value map "$method" $within)" = 100 ] || fail "$method: all images within the bounds: $(cat results/real_photos.csv)"
  expect "$(value map "$method" $focal) < 0.2"
done
[ "$(grep -c '^own,map,photo_' results/real_photos_queries.csv)" -ge 40 ] || fail "a row for each image and method"
expect "$(value map "hybridgv image_registrator" 15) > 0.1"
grep -q '^| own map | .*image_registrator.* | 100 %, 100 % | ' log || fail "a table to read: $(cat log)"
[ -s results/own.map.html ] || fail "a page"
if command -v colmap > /dev/null; then
  [ "$(value map "colmap image_registrator" $registered)" = 100 ] || fail "COLMAP's images: $(cat results/real_photos.csv)"
fi
if command -v gnuplot > /dev/null; then [ -s results/real_photos.svg ] || fail "a picture"; fi

# A reference in another frame: the model with all images, twice as large. What hybridgv has written is then without error.
mkdir -p all/maps/some.1 all/maps/some.2 all/hybridgv all/reference
cp own/database.db all && cp own/map/* all/maps/some.1 && cp own/map/* all/maps/some.2
echo photo_12.jpg > all/maps/some.2/queries.txt
cp -r results/own/hybridgv/map all/hybridgv/some.1
"$build/src/program/hybridgv" image_registrator --database_path own/database.db --input_path own/map --output_path text --output_type TXT --quiet
awk '/^#/ || ++n % 2 == 0 { print; next } { $6 *= 2; $7 *= 2; $8 *= 2; print }' OFMT=%.17g CONVFMT=%.17g text/images.txt > all/reference/images.txt
awk '/^#/ { print; next } { $2 *= 2; $3 *= 2; $4 *= 2; print }' OFMT=%.17g CONVFMT=%.17g text/points3D.txt > all/reference/points3D.txt
cp text/cameras.txt all/reference
"$program" --quiet --repetitions 1 --output results all || fail "a reference of all images"
expect "$(value some "hybridgv image_registrator" $focal) < 1e-6 && $(value some "hybridgv image_registrator" $position) < 1e-6"
[ "$(value some "hybrid; verified matches" 4)" = 9 ] || fail "eight images and one: $(cat results/real_photos.csv)"

"$program" --quiet --quick --output results all || fail "--quick"
[ "$(value some "hybrid; verified matches" 4)" = 8 ] || fail "one map of each kind: $(cat results/real_photos.csv)"

expect_error() {
  message=$1 && shift
  "$@" > log 2>&1 && fail "$* must fail"
  grep -q "$message" log || fail "$* must say $message: $(cat log)"
}
mkdir empty
expect_error "nowhere" "$program" nowhere
expect_error "empty/reference" "$program" --output results empty
mkdir -p mapless/maps && cp -r all/reference mapless
expect_error "mapless/maps is empty" "$program" --output results mapless
expect_error "no reference.txt" sh "$script" --work other --build "$build" --prepared empty
expect_error "no such folder" sh "$script" --work other --build "$build" --prepared nowhere
expect_error "no option --nonsense" sh "$script" --nonsense
expect_error "which folders" sh "$script"
echo "map photo.jpg 100 100 90 0 1 0 0" > empty/reference.txt
expect_error "not a reference" "$program" --output results empty

if [ -e "$realdata/photos/reference.txt" ]; then
  sh "$script" --work results --build "$build" --prepared "$realdata/photos" > log 2>&1 || fail "$realdata/photos: $(cat log)"
  for method in "hybrid; verified matches" "hybrid; raw matches"; do
    expect "$(value all "$method" $registered) == 100 && $(value all "$method" $within) > 90"  # measured: 99 and 96
    expect "$(value all "$method" $focal) < 0.8 && $(value all "$method" $position) < 1.2"  # measured: 0.65 and 0.44, 0.96 and 0.51
    expect "$(value all "$method" $focal) < $(value all "2D-3D only; verified matches" $focal)"
  done
  # From features and matches on: the reference, and maps of three images and of all but one.
  if command -v colmap > /dev/null; then
    sh "$script" --work chain --build "$build" --every 5 --sizes 3 "$realdata/photos/database.db" > log 2>&1 || fail "the chain: $(cat log)"
    for kind in 3_images without; do
      rows=$(grep -c "^database,$kind," chain/real_photos.csv)
      [ "$rows" = 6 ] || fail "$rows methods on maps $kind: $(cat log)"
    done
    [ "$(grep "^database,without,hybrid; verified" chain/real_photos.csv | cut -d, -f 6)" = 100 ] || fail "all but one: $(cat log)"
  fi
else
  echo "no folder $realdata/photos: its part is skipped"
fi
echo passed
