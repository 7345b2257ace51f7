#!/bin/sh
# Every code block of README.md that follows a line `<!-- from FILE -->` must be, word for word, what stands between the
# `// [readme]` (Python: `# [readme]`) markers of matlab_free_examples/FILE (indentation removed). So what the README shows is compiled and run.
cd "$(dirname "$0")/.." || exit 1
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
count=0
for file in $(sed -n 's/^<!-- from \(.*\) -->$/\1/p' README.md); do
  awk -v name="$file" '$0 == "<!-- from " name " -->" { wanted = 1 }
       /^```/ { if (inside) exit; if (wanted) { inside = 1; next } }
       inside' README.md > "$scratch/readme"
  awk '/^ *(\/\/|#) \[readme\]/ { inside = !inside; next } inside' "matlab_free_examples/$file" | sed 's/^  //' > "$scratch/example"
  [ -s "$scratch/example" ] || { echo "matlab_free_examples/$file has no [readme] part"; exit 1; }
  diff -u "$scratch/readme" "$scratch/example" || { echo "README.md and matlab_free_examples/$file differ"; exit 1; }
  count=$((count + 1))
done
[ "$count" -gt 0 ] && echo "$count snippets agree"
