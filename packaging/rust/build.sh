#!/bin/sh
# Makes a folder of the crate with the C in it, for cargo package and cargo publish: packaging/rust/build.sh FOLDER, a new one.
set -eu
test $# -eq 1 || { sed -n '2s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
mkdir -p "$1/csrc"
cp -R "$here/Cargo.toml" "$here/README.md" "$here/build.rs" "$here/src" "$here/tests" "$root/LICENSE" "$1"
cp -R "$root/src/." "$root/include/." "$1/csrc"
