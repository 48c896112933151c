# needs.sh - says which packages of Debian a build lacks, for the scripts that source it.
missing=

# lacks PACKAGE COMMAND...: notes the package unless the command succeeds.
lacks() {
    package=$1
    shift
    "$@" >/dev/null 2>&1 || missing="$missing $package"
}

# Notes what compiles WebAssembly. Who names another compiler has its linker and libraries elsewhere.
lacks_compiler() {
    lacks "${WASM_CC:-clang-19}" command -v "${WASM_CC:-clang-19}"
    test -z "${WASM_CC:-}" || return 0
    lacks lld-19 command -v wasm-ld-19
    lacks wasi-libc test -e /usr/include/wasm32-wasi/stdio.h
    lacks libclang-rt-19-dev-wasm32 test -e /usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a
}

# Ends the script if a package is missing.
check_missing() {
    test -n "$missing" || return 0
    echo "build.sh: packages are missing: apt-get install$missing" >&2
    exit 1
}
