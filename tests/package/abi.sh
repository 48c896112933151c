#!/bin/sh
# The library's binary interface is the recorded one, to which functions may be added: abi.sh ROOT [record]
# The record is libtribox1.abi, beside this script; `record` writes it anew, with a release that adds to it. Kernels export nothing,
# and are left out.
. "$(dirname "$0")/parts.sh"
root=$1
record=$here/libtribox1.abi
for program in gcc abidw abidiff; do
    command -v $program >/dev/null || skip "there is no $program (Debian: abigail-tools)"
done
test "$(uname -m)" = x86_64 || skip 'the record is of x86-64'

# library ROOT FILE...: compiles these files, and puts all that is compiled into one library
library() {
    tree=$1
    shift
    printf '%s\n' "$@" |
        xargs -P 2 -I FILE sh -c 'exec gcc -std=c11 -g -O0 -fPIC -fvisibility=hidden -I"$0/include" -I"$0/src" -c "$1" \
        -o "$2/$(basename "$1").o"' "$tree" FILE "$work"
    gcc -shared -Wl,-soname,libtribox.so.1 "$work"/*.o -o "$work/libtribox.so"
    abidw --headers-dir "$tree/include" --drop-private-types --exported-interfaces-only --no-corpus-path --no-comp-dir-path \
        --no-show-locs --no-elf-needed --no-parameter-names --no-write-default-sizes "$work/libtribox.so" >"$work/libtribox1.abi"
}

vocabularies=$(sed -n 's/^[a-z0-9]* \([a-z0-9]*\)$/\1/p' "$root/src/kernels.txt" | paste -sd'|')
# shellcheck disable=SC2046
library "$root" $(find "$root/src" -name '*.c' | grep -vE "/src/($vocabularies)/")
if test "${2-}" = record; then
    cp "$work/libtribox1.abi" "$record"
    exit
fi
abidiff --no-added-syms "$record" "$work/libtribox1.abi" || die 'programs built with an earlier 1.x would break'

# A function that loses its argument is seen.
mkdir "$work/lost"
cp -R "$root/include" "$root/src" "$work/lost"
sed -i -e 's/tribox_mask_words(size_t count)/tribox_mask_words(void)/' -e '/tribox_mask_words(/s/tribox_words_of(count)/0/' \
    "$work/lost/include/tribox.h" "$work/lost/src/base/mask.c"
library "$work/lost" "$work/lost/src/base/mask.c"
! abidiff --no-added-syms "$record" "$work/libtribox1.abi" >"$work/seen" ||
    die 'tribox_mask_words loses its argument, and nothing is seen'
grep -q tribox_mask_words "$work/seen"
