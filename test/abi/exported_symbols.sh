#!/bin/sh
# usage: exported_symbols.sh NM LIBRARY
# The library must export its own names only. A weak symbol of a template (Eigen's, or std::'s with Eigen types) would be replaced
# by the copy of a program that was compiled for another instruction set, whose memory layout and allocation differ.
symbols=$("$1" -DC --defined-only "$2") || exit 1
[ -n "$symbols" ] || { echo "$2 exports nothing"; exit 1; }
foreign=$(echo "$symbols" | grep ' [WVu] .*Eigen')
[ -z "$foreign" ] || { echo "weak symbols with Eigen types:"; echo "$foreign"; exit 1; }
foreign=$(echo "$symbols" | grep -vE '^[0-9a-f]+ . (typeinfo for |typeinfo name for |vtable for |VTT for )?hybridgv::' | grep -vE ' A ')
[ -z "$foreign" ] || { echo "symbols that are not the library's own:"; echo "$foreign"; exit 1; }
echo "$(echo "$symbols" | wc -l) symbols, all of namespace hybridgv"
