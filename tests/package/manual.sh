#!/bin/sh
# The manual pages draw no warning from mandoc and groff, and the example of tribox(3) compiles and runs: manual.sh ROOT LIBDIR
# The installed page is found under the name of every function.
. "$(dirname "$0")/parts.sh"
install_build
source=$1 libdir_built=$2
page=$(find "$root" -name tribox.3)

for each in "$page" $(find "$root" -name tribox.1); do
    if command -v mandoc >/dev/null; then
        mandoc -Tlint -Wwarning "$each" || die "mandoc warns about ${each##*/}"
    fi
    if command -v groff >/dev/null; then
        warnings=$(groff -ww -mdoc -Tascii "$each" 2>&1 >/dev/null)
        test -z "$warnings" || die "groff warns about ${each##*/}: $warnings"
    fi
done

for symbol in $("$source/packaging/symbols.sh"); do
    test -f "${page%/*}/$symbol.3" || die "no manual page is installed under the name of $symbol"
done

awk '/^\.Sh/ { inside = 0 } /^\.Sh EXAMPLES/ { inside = 1 } /^\.Ed/ { literal = 0 }
     inside && literal { gsub(/\\e/, "\\"); print } /^\.Bd/ { literal = 1 }' "$page" >"$work/example.c"
$CC $SANITIZER -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$source/include" "$work/example.c" -o "$work/example" \
    -L"$libdir_built" -ltribox -lm -Wl,-rpath,"$libdir_built"
"$work/example" >"$work/printed"
echo '1 of 2 triangles overlap' | diff - "$work/printed" ||
    die "the example of tribox(3) prints something else"
