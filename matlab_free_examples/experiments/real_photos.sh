#!/bin/sh
# How well is an image localized that is not in the map? For each folder of images: features, matches and a reconstruction of all of them by
# COLMAP (the reference); then maps that lack some; then every image that a map lacks, by this library from both kinds of matches and from
# 2D-3D matches alone, and by COLMAP's image_registrator.
#
#   sh real_photos.sh [options] IMAGES ...              folders of images, one for each scene; or COLMAP's databases with matched features
#   sh real_photos.sh [options] --prepared FOLDER ...   folders with database.db, maps and reference.txt (see PhotoSets.hpp)
#
#   --work FOLDER    where everything is written (build/real_photos); what is there already is not made again
#   --every N        leave out every N-th image only
#   --queries LIST   leave out the images named in this file, all at once, and nothing else
#   --sizes "3 4 5"  maps of so many images, chosen at random from those that share points with the one that is left out
#   --draws N        so many maps of each size for each image (1)
#   --matcher NAME   exhaustive (default) or sequential; a file of visual words: vocab_tree with it
#   --gpu            COLMAP may use the graphics card
#   --seed S         of the choice of images
#   --build FOLDER   a build of this project (default: it is built in build/demo)
#
# Maps: fold.K, made by COLMAP's mapper of two thirds of the images; without.I, all images but one, and N_images.I, both with the reference's
# poses and points triangulated from these images alone.
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$root/build/real_photos every=1 queries= sizes="3 4 5" draws=1 matcher=exhaustive gpu=0 seed=1 build= prepared=no
die() { echo "real_photos.sh: $1" >&2; exit 1; }
while [ $# -gt 0 ]; do
  case $1 in
    --work) work=$2 && shift ;;
    --every) every=$2 && shift ;;
    --queries) queries=$(realpath "$2") && shift ;;
    --sizes) sizes=$2 && shift ;;
    --draws) draws=$2 && shift ;;
    --matcher) matcher=$2 && shift ;;
    --seed) seed=$2 && shift ;;
    --build) build=$(realpath "$2") && shift ;;
    --gpu) gpu=1 ;;
    --prepared) prepared=yes ;;
    -h | --help) sed -n '2,/^root=/s/^# \{0,1\}//p' "$0" && exit ;;
    -*) die "no option $1; see --help" ;;
    *) break ;;
  esac
  shift
done
[ $# -gt 0 ] || die "which folders? see --help"
[ -z "$queries" ] || [ -f "$queries" ] || die "$queries: no such file"
export QT_QPA_PLATFORM=offscreen

build_programs() {
  sh "$root/.ci/install_packages.sh" build examples program pictures peers || exit 1
  build=$root/build/demo
  cmake -S "$root" -B "$build" -G Ninja -DHYBRIDGV_BUILD_TESTS=OFF -DHYBRIDGV_BUILD_BENCHMARKS=OFF > /dev/null || exit 1
  cmake --build "$build" --target hybridgv_program real_photos || exit 1
}

# COLMAP, silent unless it fails.
run_colmap() { colmap "$@" > "$set/log.txt" 2>&1; }
must_colmap() { run_colmap "$@" || die "colmap $1 failed: $(tail -3 "$set/log.txt")"; }

# The names of the posed images of a model in text.
names_of() { grep -v '^#' "$1/images.txt" | sed -n 'p;n' | cut -d ' ' -f 10-; }

# Of the models in a folder, the one with the most images.
largest_model() {
  for model in "$1"/*/; do
    [ -d "$model" ] || continue
    echo "$(colmap model_analyzer --path "$model" 2>&1 | sed -n 's/.*Registered images: //p') $model"
  done | sort -n | tail -1 | cut -d ' ' -f 2-
}

match_images() {
  if [ -f "$source" ]; then
    cp "$source" "$set/database.db" && chmod u+w "$set/database.db" && mkdir -p "$images"
    return
  fi
  must_colmap feature_extractor --database_path "$set/database.db" --image_path "$images" --SiftExtraction.use_gpu $gpu
  case $matcher in
    exhaustive | sequential) must_colmap "${matcher}_matcher" --database_path "$set/database.db" --SiftMatching.use_gpu $gpu ;;
    *) must_colmap vocab_tree_matcher --database_path "$set/database.db" --SiftMatching.use_gpu $gpu \
      --VocabTreeMatching.vocab_tree_path "$matcher" ;;
  esac
}

reconstruct_all() {
  mkdir -p "$set/all" "$set/text"
  must_colmap mapper --database_path "$set/database.db" --image_path "$images" --output_path "$set/all"
  model=$(largest_model "$set/all")
  [ -n "$model" ] || die "$images: COLMAP finds no reconstruction"
  cp -r "$model" "$set/reference"
  # The text is for this script alone: COLMAP does not read names with blanks from it.
  must_colmap model_converter --input_path "$model" --output_path "$set/text" --output_type TXT
  names_of "$set/text" > "$set/names.txt"
}

# make_map NAME [IMAGE]: a map of the images in kept.txt, with the reference's poses and points of their own, in which the image is looked for.
make_map() {
  map=$set/maps/$1
  mkdir -p "$map" "$set/posed"
  grep -vxF -f "$set/kept.txt" "$set/names.txt" > "$set/deleted.txt"
  run_colmap image_deleter --input_path "$set/reference" --output_path "$set/posed" --image_names_path "$set/deleted.txt" &&
    run_colmap point_triangulator --database_path "$set/database.db" --image_path "$images" --input_path "$set/posed" \
      --output_path "$map" --clear_points 1
  if [ ! -e "$map/images.bin" ]; then
    echo "no map $1: $(tail -1 "$set/log.txt")" && rm -rf "$map"
  elif [ -n "$2" ]; then
    echo "$2" > "$map/queries.txt"
  fi
}

# As many images as are wanted, of those that share 15 points or more with the one whose name is $1.
choose_partners() {
  awk -v name="$1" -v size="$2" -v seed="$seed$3" '
    FNR == 1 { ++file }
    /^#/ { next }
    file == 1 && ++line % 2 { n = $0; for (i = 1; i < 10; ++i) sub(/^[^ ]* /, "", n); names[$1] = n; if (n == name) id = $1; next }
    file == 2 {
      seen = 0
      for (i = 9; i < NF; i += 2) if ($i == id) seen = 1
      if (seen) for (i = 9; i < NF; i += 2) ++shared[$i]
    }
    END {
      srand(seed)
      for (i in shared) if (i != id && shared[i] >= 15) printf "%.9f %s\n", rand(), names[i]
    }' "$set/text/images.txt" "$set/text/points3D.txt" | sort | head -n "$2" | cut -d ' ' -f 2- > "$set/kept.txt"
  [ "$(wc -l < "$set/kept.txt")" = "$2" ]
}

make_folds() {
  for fold in 1 2 3; do
    awk -v fold=$fold 'NR % 3 != fold - 1' "$set/names.txt" > "$set/kept.txt"
    mkdir -p "$set/fold"
    run_colmap mapper --database_path "$set/database.db" --image_path "$images" --image_list_path "$set/kept.txt" --output_path "$set/fold"
    model=$(largest_model "$set/fold")
    if [ -e "$model/images.bin" ]; then mv "$model" "$set/maps/fold.$fold"; else echo "no map fold.$fold: COLMAP finds none"; fi
    rm -rf "$set/fold"
  done
}

make_maps() {
  mkdir -p "$set/maps"
  if [ -n "$queries" ]; then
    grep -vxF -f "$queries" "$set/names.txt" > "$set/kept.txt"
    make_map given.1
    return
  fi
  make_folds
  awk -v every="$every" '(NR - 1) % every == 0 { print NR " " $0 }' "$set/names.txt" > "$set/left_out.txt"
  while read -r number name; do
    grep -vxF -e "$name" "$set/names.txt" > "$set/kept.txt"
    make_map "without.$number" "$name"
    for size in $sizes; do
      for draw in $(seq "$draws"); do
        choose_partners "$name" "$size" "$number$draw" && make_map "${size}_images.$number.$draw" "$name"
      done
    done
  done < "$set/left_out.txt"
}

# The processor time [s] of all programs that were run and waited for so far. Not in $(..), which would be a shell of its own.
processor_seconds() {
  times > "$set/times.txt"
  seconds=$(awk 'NR == 2 { split($1, own, "m"); split($2, kernel, "m"); print 60 * (own[1] + kernel[1]) + own[2] + kernel[2] }' "$set/times.txt") || die "times: $(cat "$set/times.txt")"
}

# register_images MAP: by both programs, with one thread each.
register_images() {
  map=$set/maps/$1 list=
  [ "$prepared" = no ] || map=$set/$1
  [ ! -e "$map/queries.txt" ] || list="--image_list_path $map/queries.txt"
  mkdir -p "$set/colmap/$1" "$set/hybridgv/$1"
  processor_seconds && start=$seconds
  run_colmap image_registrator --database_path "$set/database.db" --input_path "$map" --output_path "$set/colmap/$1" --Mapper.num_threads 1
  processor_seconds && middle=$seconds
  "$build/src/program/hybridgv" image_registrator --database_path "$set/database.db" --input_path "$map" --output_path "$set/hybridgv/$1" \
    --Mapper.num_threads 1 $list > "$set/log.txt" 2>&1 || die "hybridgv image_registrator: $(tail -3 "$set/log.txt")"
  processor_seconds && end=$seconds
  if [ -e "$set/colmap/$1/images.bin" ]; then
    echo "$start $middle" | awk '{ print $2 - $1 }' > "$set/colmap/$1/seconds.txt"
  else
    rm -r "$set/colmap/$1"
  fi
  tried=
  [ -z "$list" ] || tried=$(wc -l < "$map/queries.txt")
  echo "$middle $end" | awk -v tried="$tried" '{ print $2 - $1, tried }' > "$set/hybridgv/$1/seconds.txt"
}

# draw_page MAP: the result to look at.
draw_page() {
  map=$set/maps/$1 pictures=
  [ "$prepared" = no ] || map=$set/$1
  [ "$prepared" = yes ] || pictures="--image_path $images"
  "$build/src/program/hybridgv" image_registrator --database_path "$set/database.db" --input_path "$map" --quiet \
    --html_path "$work/$(basename "$set").$1.html" $pictures || die "no page of $1"
}

map_names() {
  if [ "$prepared" = yes ]; then
    grep -v '^#' "$set/reference.txt" | cut -d ' ' -f 1 | sort -u
  else
    ls "$set/maps"
  fi
}

[ -n "$build" ] || build_programs
command -v colmap > /dev/null || [ "$prepared" = yes ] || die "COLMAP is missing (Debian package colmap)"
mkdir -p "$work" && work=$(realpath "$work")
count=$#
for folder; do
  source=$(realpath "$folder")
  [ -d "$source" ] || [ -f "$source" -a "$prepared" = no ] || die "$source: no such folder"
  set=$work/$(basename "$source" .db)
  images=$source
  [ -d "$source" ] || images=$set/no_images  # COLMAP asks for a folder of images, but needs their colours only
  if [ ! -e "$set/done" ]; then
    rm -rf "$set" && mkdir -p "$set"
    echo "$source"
    if [ "$prepared" = yes ]; then
      [ -e "$source/reference.txt" ] || die "$source has no reference.txt"
      cp -r "$source"/. "$set" && chmod -R u+w "$set"
    else
      match_images && reconstruct_all && make_maps
    fi
    for name in $(map_names); do
      register_images "$name"
      case $prepared$name in yes* | *fold.* | *given.*) draw_page "$name" ;; esac
    done
    touch "$set/done"
  fi
  set -- "$@" "$set"
done
shift "$count"
"$build/matlab_free_examples/experiments/real_photos" --seed "$seed" --output "$work" "$@" || exit 1
sh "$root/matlab_free_examples/experiments/plot.sh" "$work" || [ $? = 77 ] || exit 1
awk -f "$root/matlab_free_examples/experiments/real_photos_table.awk" "$work/real_photos.csv"
echo "results: $work"
