#!/bin/sh
# The kernel text knows no instruction set, and includes nothing: kernel_text.sh SRC
set -eu
cd "$1/kernel"

forbidden='__AVX|__SSE|__FMA|__ARM|__aarch64|__x86_64|__i386|_M_X64|TRIBOX_X86|_mm_|_mm256_|_mm512_|__m128|__m256|__m512|__mmask'
forbidden="$forbidden|float32x4|v[a-z]+q_f32|#[[:space:]]*include"

status=0
for text in *.h; do
    if grep -nE "$forbidden" "$text"; then
        echo "src/kernel/$text: an instruction set or an include in the kernel text; make it a word in vec_<isa>.h" >&2
        status=1
    fi
done
exit $status
