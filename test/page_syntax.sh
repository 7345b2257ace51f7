#!/bin/sh
# usage: page_syntax.sh PAGE.js   the script of the page, read by node. Skipped where node is not installed.
if ! command -v node > /dev/null; then
  echo "node is missing (Debian package nodejs): skipped"
  exit 77
fi
node --check "$1"
