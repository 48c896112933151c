#!/bin/sh
# Each object of a kernel exports one symbol, named after it, calls no function of src, and has no writable data:
# kernel_symbols.sh NM OBJDUMP KERNEL LIBRARY
set -eu
nm=$1 objdump=$2 kernel=$3 library=$4

"$nm" --extern-only --defined-only "$library" | awk -v kernel="$kernel" '
    function judge() {
        if (!object || (exported == 1 && name ~ "^tribox_[a-z]+_" kernel "$")) return
        print object " should export tribox_<what>_" kernel " and nothing else, but exports " exported ", the last one " name
        status = 1
    }
    NF == 1 && /:$/ { judge(); object = $0; exported = 0; name = "" }
    NF == 3 && $3 !~ /^__x86\.get_pc_thunk/ { exported++; name = $3 } # 32-bit x86 reads its own address there
    END { judge(); if (!object) { print "no objects"; status = 1 } exit status }' >&2

# Its own tables alone: what a text leaves to others is handed in, as a pointer or in a list.
calls=$("$nm" --undefined-only "$library" |
    awk -v kernel="$kernel" '$2 ~ /^tribox_/ && $2 !~ "^tribox_[a-z]+_" kernel "$" { print $2 }')
if test -n "$calls"; then
    echo "$kernel: a kernel text calls $calls; let the caller hand it in (tribox_voxel_handlers) or drain a list" >&2
    exit 1
fi

# .data.rel.ro is made read-only after relocation: the descriptor lies there.
writable=$("$objdump" -h -w "$library" |
    awk '$2 ~ /^\.(data|bss|tdata|tbss)/ && $2 !~ /^\.data\.rel\.ro/ && $3 !~ /^0*$/ { print $2, $3 }')
if test -n "$writable"; then
    echo "$kernel: writable data in a kernel object (section, size in hexadecimal): $writable" >&2
    exit 1
fi
