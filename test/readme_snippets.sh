#!/bin/sh
# Every code block of README.md and of the pages in src/doc that follows a line `<!-- from FILE -->` must be, word for word, what stands
# between the `// [readme]` (Python: `# [readme]`) markers of matlab_free_examples/FILE (without the first line's indentation). So what the
# pages show is compiled and run.
cd "$(dirname "$0")/.." || exit 1
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
count=0
for page in README.md src/doc/*.md; do
  for file in $(sed -n 's/^<!-- from \(.*\) -->$/\1/p' "$page"); do
    awk -v name="$file" '$0 == "<!-- from " name " -->" { wanted = 1 }
         /^```/ { if (inside) exit; if (wanted) { inside = 1; next } }
         inside' "$page" > "$scratch/page"
    awk '/^ *(\/\/|#) \[readme\]/ { inside = !inside; next }
         inside { if (indent == "") { match($0, /^ */); indent = 1 + RLENGTH } print substr($0, 1, indent - 1) ~ /^ *$/ ? substr($0, indent) : $0 }' \
      "matlab_free_examples/$file" > "$scratch/example"
    [ -s "$scratch/example" ] || { echo "matlab_free_examples/$file has no [readme] part"; exit 1; }
    diff -u "$scratch/page" "$scratch/example" || { echo "$page and matlab_free_examples/$file differ"; exit 1; }
    count=$((count + 1))
  done
done
[ "$count" -gt 0 ] && echo "$count snippets agree"
