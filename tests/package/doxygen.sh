#!/bin/sh
# Doxygen reads the headers without a warning and describes every function: doxygen.sh ROOT
set -eu
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A header that has no comment must be a failure, or this test proves nothing.
documented() (
    cd "$1"
    { cat packaging/doxygen/Doxyfile; printf 'OUTPUT_DIRECTORY = %s\nGENERATE_XML = YES\n' "$work/$2"; } | doxygen -
)

mkdir -p "$work/bare/include" "$work/bare/packaging"
cp -R "$root/packaging/doxygen" "$work/bare/packaging"
for header in tribox.h tribox_threads.h; do
    sed -e '/^ *\/\*\*/,/\*\//d' "$root/include/$header" >"$work/bare/include/$header"
done
if documented "$work/bare" bare_out 2>/dev/null; then
    echo "Doxygen accepts a header without comments" >&2
    exit 1
fi

documented "$root" out
"$root/packaging/symbols.sh" | while read -r symbol; do
    if ! grep -q "<name>$symbol</name>" "$work"/out/xml/tribox*_8h.xml; then
        echo "$symbol is not in Doxygen's pages" >&2
        exit 1
    fi
done
