# digests.sh - read by the scripts beside it.
# build_digests PROGRAM ROOT LIBRARY COMPILER...: the program of tests/cross that compares answers with masks.txt, with that library
# or these objects, which a file names after an @

build_digests() {
    program=$1 tree=$2 library=$3
    shift 3
    "$@" -std=c11 $(sed -n s/^all://p "$tree/src/kernels.txt") -I"$tree/include" -I"$tree/src" -I"$tree/tools" -I"$tree/tests" -I"$tree/tests/kernels" \
        "$tree"/tests/cross/masks*.c "$tree/tests/kernels/drawn_pairs.c" "$tree"/tests/doubles/scenes_f64.c \
        "$tree"/tests/common/scenes*.c "$tree/tests/common/arguments.c" \
        "$tree/tests/common/contact.c" "$library" -lm -o "$program"
}
