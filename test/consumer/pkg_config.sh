#!/bin/sh
# usage: pkg_config.sh BUILD_DIR PREFIX LIBDIR COMPILER [flags]   builds core.cpp with the flags that pkg-config gives, and runs it
set -e
build=$1 libraries=$2/$3 source=$(dirname "$0")/core.cpp
shift 3
mkdir -p "$build"
PKG_CONFIG_PATH=$libraries/pkgconfig
export PKG_CONFIG_PATH
"$@" -std=c++17 "$source" -o "$build/core" $(pkg-config --cflags --libs hybridgv)
LD_LIBRARY_PATH=$libraries "$build/core"
