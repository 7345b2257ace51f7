#!/bin/sh
# usage: debian_packages.sh FOLDER   as root on a Debian system that may be changed, such as a fresh chroot
# Installs the packages that .ci/make_packages.sh has left in FOLDER, with what they depend on, and builds and runs the project of
# this folder against them: with CMake, core program and OpenGV's loops, and with pkg-config.
set -e
packages=$(cd "$1" && pwd)
cd "$(dirname "$0")"
apt-get update -qq
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends g++ cmake make pkg-config "$packages"/libhybridgv*.deb "$packages"/hybridgv*.deb \
  "$packages"/python3-hybridgv*.deb
grep -H . /var/lib/dpkg/info/libhybridgv0*.shlibs  # what packages of programs that use the library will depend on
build=$(mktemp -d)
sh ./check.sh "$build/core" "headers core"
sh ./check.sh "$build/loops" loops
g++ -std=c++17 core.cpp -o "$build/with_pkg_config" $(pkg-config --cflags --libs hybridgv)
"$build/with_pkg_config"
rm -r "$build"
hybridgv --version
hybridgv localize --query 3
python3 -c "import hybridgv; print(hybridgv.__version__, hybridgv.localize([], [], camera=(640, 480)))"
python3 -m hybridgv localize --query 3
apt-get purge -y -qq python3-hybridgv hybridgv libhybridgv-dev 'libhybridgv-colmap0*' 'libhybridgv0*'
echo "packages installed, used and removed"
