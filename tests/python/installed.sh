#!/bin/sh
# The installed module finds the installed library, and is right: installed.sh TEST.py ...
# There are two ways to the library: by its name, as after ldconfig, and by TRIBOX_LIBRARY.
. "$(dirname "$0")/../package/parts.sh"
install_build

module=$(find "$root" -path '*/tribox/__init__.py')
test -n "$module" || die "the module is not installed"
export PYTHONPATH="${module%/tribox/__init__.py}"
cd "$work"

# ask TEST...: is it the module that was installed, and right?
ask() {
    file=$("$PYTHON" -B -c 'import tribox; print(tribox.__file__)')
    test "$file" = "$module" || die "imported $file and not $module"
    for test; do
        "$PYTHON" -B "$test"
    done
}

unset TRIBOX_LIBRARY
(export LD_LIBRARY_PATH="$libdir"; ask "$@")
(export TRIBOX_LIBRARY="$libdir/libtribox.so.1"; ask "$1")

if "$PYTHON" -B -c 'import tribox' 2>"$work/error"; then
    echo "a libtribox of this machine's own was found without either" >&2
else
    grep -q 'ImportError: .*libtribox.so.1.*TRIBOX_LIBRARY' "$work/error" || die "not clear: $(cat "$work/error")"
fi
