#!/bin/sh
# What a reader of README.md, BUILD.md and examples/README.md types works: readme.sh example|by-hand ROOT LIBDIR
#   example  the first C block with a main of each page that has one, and all of C++, compile without a warning and run
#   by-hand  the block of BUILD.md with "ar rcs" builds without meson or CMake, on x86-64; the program that it makes runs, and
#            the library has the kernels of the one in LIBDIR
. "$(dirname "$0")/parts.sh"
what=$1 root=$2 libdir=$3

# The first fenced block of a page whose opening line and text match: block PAGE FENCE TEXT
block() {
    awk -v fence="$2" -v text="$3" '
        /^```/ && !inside { inside = 1; is_wanted = $0 ~ fence; body = ""; next }
        /^```/            { inside = 0; if (is_wanted && body ~ text) { printf "%s", body; exit }; next }
        inside            { body = body $0 "\n" }' "$root/$1"
}

test -f "$root/README.md" || skip "there is no README.md"
example=$(block README.md '^```c$' 'int main')

if test "$what" = example; then
    for page in README.md examples/README.md; do
        block "$page" '^```c$' 'int main' >"$work/example.c"
        test -s "$work/example.c" || die "$page has no C block with a main"
        $CC $SANITIZER -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$root/include" "$work/example.c" -o "$work/example" \
            -L"$libdir" -ltribox -lm -Wl,-rpath,"$libdir"
        "$work/example"
    done
    test -n "$CXX" || exit 0
    {
        echo '#include <cstdio>
            #include <tribox.hpp>
            #include <vector>
            struct float3 { float x, y, z; };
            int main() {
            const std::vector<float3> vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
            const std::vector<uint32_t> corners = {0, 1, 2};
            std::vector<uint64_t> mask(1);
            const tribox::grid grid({0, 0, 0}, 1, {2, 2, 2});
            uint32_t height[2][2];'
        sed -n '/^```cpp/,/^```$/p' "$root/README.md" | grep -v '^```'
        echo '}'
    } >"$work/example.cc"
    $CXX $SANITIZER -std=c++17 -Wall -Wextra -Wpedantic -Werror -I"$root/include" "$work/example.cc" -o "$work/example" \
        -L"$libdir" -ltribox -Wl,-rpath,"$libdir"
    test "$("$work/example")" = "triangle 0 overlaps"
    exit
fi

test "$(uname -m)" = x86_64 || skip "the lines that build by hand are for x86-64"
commands=$(block BUILD.md '^```' 'ar rcs')
test -n "$commands" || skip "BUILD.md has no lines that build by hand"
cp -R "$root/include" "$root/src" "$work"
cd "$work"
# The program that the lines name and the tree does not have is the example.
for file in $(printf '%s\n' "$commands" | grep -oE '[A-Za-z0-9_/]+\.c\>'); do
    test -f "$file" || printf '%s\n' "$example" >"$file"
done
cc() { command $CC -Werror "$@" -O0; } # in a third of the time
eval "$commands"
./example

consumer=$root/tests/package/consumer/consumer.c
cc -Iinclude "$consumer" libtribox.a -lm -o by_hand
cc -Iinclude "$consumer" -L"$libdir" -ltribox -lm -Wl,-rpath,"$libdir" -o by_meson
./by_meson kernels >kernels
./by_hand kernels | diff kernels - || die "other kernels (>) than meson's library has (<)"
