#!/bin/sh
# The kernel text knows no instruction set, and only the umbrella texts include others: kernel_text.sh SRC
set -eu
cd "$1/kernel"

forbidden='__AVX|__SSE|__FMA|__ARM|__aarch64|__x86_64|__i386|_M_X64|TRIBOX_AVX|_mm_|_mm256_|_mm512_|__m128|__m256|__m512|__mmask'
forbidden="$forbidden|float32x4|v[a-z]+q_f32"
include='#[[:space:]]*include'

status=0
for text in $(find . -name '*.h' | sed 's,^\./,,'); do
    case $text in
    *_text.h) refused="$forbidden|$include[[:space:]]*[^\"[:space:]]" ;;
    *) refused="$forbidden|$include" ;;
    esac
    if grep -nE "$refused" "$text"; then
        echo "src/kernel/$text: an instruction set (make it a word in vec_<isa>.h), or an include outside an umbrella text" >&2
        status=1
    fi
done
exit $status
