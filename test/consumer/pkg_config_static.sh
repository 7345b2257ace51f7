#!/bin/sh
# usage: pkg_config_static.sh BUILD_DIR PREFIX LIBDIR ARCHIVE COMPILER [flags]
# Builds core.cpp with the static library ARCHIVE and the flags that pkg-config gives for static linking, and runs it.
set -e
build=$1 prefix=$2 libdir=$3 archive=$4 source=$(dirname "$0")/core.cpp
shift 4
rm -rf "$build"
mkdir -p "$build/prefix/$libdir"
ln -s "$prefix/include" "$build/prefix/include"
cp -r "$prefix/$libdir/pkgconfig" "$build/prefix/$libdir/"
cp "$archive" "$build/prefix/$libdir/libhybridgv.a"
PKG_CONFIG_PATH=$build/prefix/$libdir/pkgconfig
export PKG_CONFIG_PATH
flags=$(pkg-config --static --cflags --libs hybridgv)
case $flags in
*-pthread*) ;;
*) echo "no -pthread in: $flags" && exit 1 ;;
esac
"$@" -std=c++17 "$source" -o "$build/core" $flags
"$build/core"
