#!/bin/sh
# usage: install_packages.sh JOB ...   installs the Debian packages of these jobs (debian_packages.txt) that are missing, as root or
# with sudo; silent if none is
set -e
list=$(dirname "$0")/debian_packages.txt
packages=
for job; do
  line=$(grep "^$job " "$list") || { echo "$list has no line $job" >&2; exit 1; }
  packages="$packages ${line#"$job"}"
done
set -- $packages
if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system; this is needed: $*" >&2
  exit 0
fi
missing=
for package; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" != 0 ]; then
  as_root=sudo
  if ! command -v sudo >/dev/null; then
    echo "Please install, as root:$missing" >&2
    exit 1
  fi
fi
echo "Installing$missing" >&2
$as_root apt-get update -qq >&2
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends $missing >/dev/null
