# parts.sh - read by the scripts that look at packages: $here, their folder, $work, removed at exit, and what several do.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

die() {
    echo "$*" >&2
    exit 1
}

skip() {
    echo "$*: skipped"
    exit 77
}

# Installs the build BUILD into an empty folder. Sets $root, $prefix and $libdir in $work. Wants $MESON.
install_build() {
    root=$work/root
    "$MESON" install -C "$BUILD" --no-rebuild --quiet --destdir "$root"
    header=$(find "$root" -name tribox.h)
    test -n "$header" || die "tribox.h is not installed"
    prefix=${header%/include/tribox.h}
    libdir=$(dirname "$(find "$root" -name 'libtribox.*' | head -n 1)")
}

# A commit of the source tree as it lies, changes that are not committed included: snapshot ROOT REPOSITORY
snapshot() {
    if ! command -v git >/dev/null || ! test -e "$1/.git" || ! git -C "$1" rev-parse --verify -q HEAD >/dev/null 2>&1; then
        skip "the tree is not a git clone"
    fi
    mkdir -p "$2"
    (cd "$1" && git ls-files -z --cached --others --exclude-standard) | (cd "$1" && xargs -0 ls -d 2>/dev/null) |
        tar -c -C "$1" -T - -f - | tar -x -C "$2" -f -
    git -C "$2" init -q -b main
    git -C "$2" add -A
    GIT_AUTHOR_DATE='2000-01-01T00:00:00Z' GIT_COMMITTER_DATE='2000-01-01T00:00:00Z' \
        git -C "$2" -c user.name=test -c user.email=test@localhost -c commit.gpgsign=false commit -q -m 'The tree as it lies'
}

# build_digests PROGRAM ROOT LIBRARY COMPILER...: the program of tests/cross that compares answers with masks.txt, with that library
# or these objects, which a file names after an @
build_digests() {
    program=$1 tree=$2 library=$3
    shift 3
    "$@" -std=c11 -I"$tree/include" -I"$tree/src" -I"$tree/tools" -I"$tree/tests" \
        -I"$tree/tests/kernels" \
        "$tree"/tests/cross/masks*.c "$tree/tests/kernels/drawn_pairs.c" "$tree"/tests/doubles/scenes_f64.c \
        "$tree"/tests/common/scenes*.c "$tree/tests/common/arguments.c" \
        "$tree/tests/common/contact.c" "$library" -lm -o "$program"
}

# Whether two builds of the libraries are the same, byte for byte: same_library FOLDER VERSION BUILD BUILD
# What was built in FOLDER may not have its path.
same_library() {
    for library in libtribox.a "libtribox.so.$2"; do
        cmp "$3/src/$library" "$4/src/$library" || exit 1
        ! grep -q "$1" "$3/src/$library" || die "$library has the folder that it was built in"
        echo "${3##*/}: $library is the same"
    done
}
