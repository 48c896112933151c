#!/bin/sh
# Makes a folder of the crate with the C in it, for cargo package and cargo publish: packaging/rust/build.sh FOLDER, a new one.
set -eu
test $# -eq 1 || { sed -n '2s/^# //p' "$0" >&2; exit 2; }
root=$(cd "$(dirname "$0")/../.." && pwd)
python3 "$root/packaging/amalgamate.py" "$1/csrc"
for part in Cargo.toml README.md build.rs src tests ../../LICENSE; do
    cp -R "$root/packaging/rust/$part" "$1"
done
