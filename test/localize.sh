#!/bin/sh
# usage: localize.sh PROGRAM MAP   the program on the default map and on wrong input
program=$1 map=$2
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }

"$program" --json --outliers 0.3 --seed 3 > "$scratch/all" || fail "default map"
[ "$(wc -l < "$scratch/all")" = "$(grep -c '"query"' "$scratch/all")" ] || fail "one object a line"
[ "$(grep -c '"hybrid":{"success":true' "$scratch/all")" = 16 ] || fail "images localized with 30 % outliers and unknown distortion"
"$program" --json --outliers 0.3 --seed 3 --undistort-query | grep -c '"hybrid":{"success":true' | grep -q '^16$' ||
  fail "all 16 images localized with 30 % outliers"

# Queries from standard input give the same objects, times aside.
without_times() { sed 's/"seconds":[^},]*//g' "$1" | sort; }
sed 's/.*"query":"\([^"]*\)".*/\1/' "$scratch/all" | "$program" "$map" --stdin --json --outliers 0.3 --seed 3 > "$scratch/stdin"
without_times "$scratch/all" > "$scratch/a" && without_times "$scratch/stdin" > "$scratch/b"
cmp "$scratch/a" "$scratch/b" || fail "--stdin"

"$program" "$map" --query photo_03.jpg 4 --solver h13f | grep -q '^photo_03.jpg' || fail "--query and --solver"
"$program" --json --outliers 0.3 --seed 3 --undistort-query --rays-only > "$scratch/rays" || fail "--rays-only"
[ "$(grep -c '"hybrid":{"success":true' "$scratch/rays")" -ge 14 ] || fail "images localized by rays only"
"$program" --help | grep -q -- '--outliers' || fail "--help"
"$program" --help | tr -s '\n ' ' ' | grep -q 'all, p4pf, .*h51f' || fail "--help lists the solvers"
expect_error() {
  message=$1 && shift
  "$program" "$@" > "$scratch/out" 2> "$scratch/error" && fail "$* must fail"
  grep -q -- "$message" "$scratch/error" || fail "$* must name $message: $(cat "$scratch/error")"
}
expect_error "no/such/map" no/such/map
expect_error "nobody.jpg" "$map" --query nobody.jpg
expect_error "h99f" --solver h99f
expect_error "H13F.*valid are all, .*h13f" --solver H13F
for share in nan -1 2 x; do expect_error "--outliers: must be from 0 to 1, is $share" --outliers $share; done
for pixels in nan inf 0 -1; do
  expect_error "--max-reprojection-error: must be positive and finite, is $pixels" --max-reprojection-error $pixels
  expect_error "--max-epipolar-error: must be positive and finite, is $pixels" --max-epipolar-error $pixels
done
for pixels in nan inf -1; do
  expect_error "--principal-point-deviation: must be finite and not negative, is $pixels" --principal-point-deviation $pixels
done
expect_error "--min-parallax: must be finite and not negative, is nan" --min-parallax nan
for seed in -1 99999999999999999999 1.5; do expect_error "--seed: must be an integer from 0 .*, is $seed" --seed $seed; done
for count in 0 -1 1.5; do expect_error "--max-iterations: must be a positive integer, is $count" --max-iterations $count; done
expect_error "--threads: must be 0 (all cores) or a positive integer, is -1" --threads -1
for probability in nan 0 1; do
  expect_error "--success-probability: must be between 0 and 1, is $probability" --success-probability $probability
done
echo "query 1 2 3" > "$scratch/broken.txt"
expect_error "broken.txt:1" "$scratch/broken.txt"
[ ! -s "$scratch/out" ] || fail "nothing on the standard output before an error: $(cat "$scratch/out")"
expect_error '"nobody\\x1b.jpg"' "$map" --query "$(printf 'nobody\033.jpg')"
expect_error "there is no map" "$scratch/broken.txt" --query photo_03.jpg

# Standard input: Windows' line ends and blanks around names; names without a map.
printf ' photo_03.jpg \r\n\r\nphoto_04.jpg\r\n' | "$program" "$map" --stdin --json > "$scratch/crlf" || fail "line ends of Windows"
[ "$(grep -c '"query":"photo_0[34].jpg"' "$scratch/crlf")" = 2 ] || fail "two queries in lines of Windows"
echo photo_03.jpg | "$program" --stdin > "$scratch/out" 2> "$scratch/error" && fail "names without a map must fail"
grep -q "name its map too" "$scratch/error" || fail "names without a map: $(cat "$scratch/error")"

# The table: 100 columns at most, a failed query has no deviation, images of the same name are all localized.
"$program" > "$scratch/table" || fail "table"
awk 'length > 100 { print; bad = 1 } END { exit bad }' "$scratch/table" || fail "the table is wider than 100 columns"
"$program" --query 3 --max-iterations 1 --outliers 1 > "$scratch/table" || fail "a query that cannot be localized"
grep -q '| *failed  *-  *-  *-  *-  .*| *failed$' "$scratch/table" || fail "a failed row: $(cat "$scratch/table")"
mkdir "$scratch/twins"
cp "$map"/cameras.txt "$map"/points3D.txt "$scratch/twins/"
sed 's/photo_0[5-9].jpg/same.jpg/' "$map/images.txt" > "$scratch/twins/images.txt"
[ "$("$program" "$scratch/twins" --query same.jpg --json | grep -c '"query":"same.jpg"')" = 5 ] || fail "images of the same name"

# The distortion: nothing of the query's calibration is used unless asked for; the default map has none.
"$program" "$map" --query 3 --json > "$scratch/radial" || fail "a query with unknown distortion"
grep -q '"radial_k":' "$scratch/radial" || fail "k1 is told: $(cat "$scratch/radial")"
grep -q '"reference_radial_k":' "$scratch/radial" || fail "the reference of k1 is told: $(cat "$scratch/radial")"
"$program" "$map" --query 3 --json --query-camera pinhole | grep -q '"radial_k":0.0,"radial_k_std":0.0' || fail "--query-camera pinhole"
"$program" "$map" --query 3 --json --undistort-query > "$scratch/undistorted" || fail "--undistort-query"
grep -q '"reference_radial_k":' "$scratch/undistorted" && fail "an undistorted query has no k1"

# An allowance for the principal point changes the deviations alone.
"$program" "$map" --query 3 --json --principal-point-deviation 8 > "$scratch/allowance" || fail "--principal-point-deviation"
deviations='"\(focal_length\|radial_k\)_std[^:]*":[^,]*,'
sed "s/$deviations//g; s/\"seconds\":[^},]*//g" "$scratch/radial" > "$scratch/a"
sed "s/$deviations//g; s/\"seconds\":[^},]*//g" "$scratch/allowance" > "$scratch/b"
cmp "$scratch/a" "$scratch/b" || fail "another result with an allowance for the principal point"
deviation() { sed 's/.*"hybrid".*"focal_length_std_px":\([0-9.e-]*\).*"points_only".*/\1/' "$1"; }
echo "$(deviation "$scratch/radial") $(deviation "$scratch/allowance")" | awk '{ exit !($2 > $1) }' ||
  fail "an allowance for the principal point: $(deviation "$scratch/radial"), $(deviation "$scratch/allowance")"
expect_error "--query-camera: fisheye not in" --query-camera fisheye

# Results that cannot be written are no success.
if [ -w /dev/full ]; then
  for format in "" --json; do
    "$program" $format > /dev/full 2> "$scratch/error" && fail "written to a full device"
    grep -q "cannot write" "$scratch/error" || fail "the message about a full device: $(cat "$scratch/error")"
  done
fi
echo passed
