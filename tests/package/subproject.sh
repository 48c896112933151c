#!/bin/sh
# A meson project has the source tree as a subproject, and finds it by dependency('tribox'): subproject.sh ROOT
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp -R "$(dirname "$0")/consumer" "$work/consumer"
mkdir "$work/consumer/subprojects"
ln -s "$1" "$work/consumer/subprojects/tribox"
# Unoptimised, the kernels take minutes to compile.
"$MESON" setup "$work/build" "$work/consumer" --optimization 1 --force-fallback-for=tribox
"$MESON" test -C "$work/build" consumer
