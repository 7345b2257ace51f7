#!/bin/sh
# Formats every C++ file of the project; with --check, only reports the files that would change.
cd "$(dirname "$0")/.." || exit 1
[ "$1" = --check ] && mode="--dry-run -Werror" || mode=-i
git ls-files -co --exclude-standard '*.cpp' '*.hpp' | xargs clang-format-14 $mode
