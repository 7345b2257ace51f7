#!/bin/sh
# Every job whose packages a script installs stands in .ci/debian_packages.txt, and no script names packages itself.
cd "$(dirname "$0")/.." || exit 1
count=0
for job in $(sed -n 's/^ *sh [^#]*install_packages\.sh"\{0,1\} //p' .ci/run .ci/*.sh test/*.sh test/fuzz/*.sh matlab_free_examples/*.sh); do
  grep -q "^$job " .ci/debian_packages.txt || { echo "FAILED: no line $job in .ci/debian_packages.txt"; exit 1; }
  count=$((count + 1))
done
[ "$count" -gt 0 ] && echo "$count jobs"
