#!/bin/sh
# Every vocabulary has the words of its one-lane definition, and each word is tested; the kernel text knows no instruction set, and
# only the umbrella texts include others: vocabularies.sh SRC TEST...
set -eu
src=$1 status=0
shift

words() { sed -nE 's/^TRIBOX_INLINE [a-z0-9_]+ ([imv]_[a-z0-9_]+)\(.*/\1/p' "$1" | sort -u; }

# For float, vec_<isa>.h; for double, vec_<isa>_double.h.
for definition in "$src"/scalar/vec_scalar*.h; do
    kind=${definition#"$src/scalar/vec_scalar"}
    defined=$(words "$definition")
    test -n "$defined" || { echo "$definition: no words found" >&2; exit 1; }
    for vocabulary in "$src"/*/vec_*"$kind"; do
        case $kind,$vocabulary in .h,*_double.h) continue ;; esac
        if test "$(words "$vocabulary")" != "$defined"; then
            echo "$vocabulary: other words than in $definition" >&2
            status=1
        fi
    done
    for word in $defined; do
        if ! grep -qE "\<$word\(" "$@"; then
            echo "$word: not tested; add it to a table of words_lanes.h" >&2
            status=1
        fi
    done
done

forbidden='__AVX|__SSE|__FMA|__ARM|__aarch64|__x86_64|__i386|_M_X64|TRIBOX_AVX|_mm_|_mm256_|_mm512_|__m128|__m256|__m512|__mmask'
forbidden="$forbidden|float32x4|v[a-z]+q_f32"
include='#[[:space:]]*include'
for text in $(cd "$src/kernel" && find . -name '*.h' | sed 's,^\./,,'); do
    case $text in
    *_text.h) refused="$forbidden|$include[[:space:]]*[^\"[:space:]]" ;;
    *) refused="$forbidden|$include" ;;
    esac
    if grep -nE "$refused" "$src/kernel/$text"; then
        echo "src/kernel/$text: an instruction set (make it a word in vec_<isa>.h), or an include outside an umbrella text" >&2
        status=1
    fi
done
exit $status
