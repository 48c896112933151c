#!/bin/sh
# The crate as it is published: packed, unpacked, and tested without a network and without the tree, with warnings as errors. Then
# the one in a clone is compiled from the clone's sources, and one without any says so: rust.sh ROOT
. "$(dirname "$0")/parts.sh"
command -v cargo >/dev/null || skip "there is no cargo"
test -z "$SANITIZER" || skip "Rust links no sanitizer's runtime"
root=$1
# Not optimised, in a sixth of the time.
export CARGO_HOME="$work/home" CARGO_TARGET_DIR="$work/target" CARGO_NET_OFFLINE=true CFLAGS=-O0 RUSTFLAGS=-Dwarnings
"$root/packaging/rust/build.sh" "$work/folder"
(cd "$work/folder" && cargo package -q --no-verify)
mkdir "$work/unpacked"
tar -x -C "$work/unpacked" -f "$work"/target/package/*.crate
cd "$work"/unpacked/*
cargo test -q

mkdir -p "$work/clone/packaging"
cp -R "$root/packaging/rust" "$work/clone/packaging"
cd "$work/clone/packaging/rust"
rm -rf csrc
! cargo check -q 2>"$work/log" || die "it builds without C"
grep -q 'makes a package that has it' "$work/log" || { cat "$work/log" >&2; die "it does not say what is missing"; }
cp -R "$root/include" "$root/src" "$work/clone"
# A compiler that only says which files it was given: the last argument is the object, and that before -o the source.
printf '#!/bin/sh\nwhile test $# -gt 3; do shift; done\necho "$1" >>"%s"\n: >"$3"\n' "$work/compiled" >"$work/cc"
chmod +x "$work/cc"
CC=$work/cc cargo check -q
sed 's,.*/src/,,' "$work/compiled" | sort >"$work/files"
(cd "$root/src" && find . -name '*.c' | sed 's,^\./,,' | sort) | diff - "$work/files" || die "it does not compile all of src"
