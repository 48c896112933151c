#!/bin/sh
# Where the version is written besides the header, it is the header's: versions.sh ROOT
set -eu
cd "$1"
version=$(packaging/version.sh)
status=0
# states FILE PATTERN: a line has the version where the pattern has VERSION
states() {
    grep -q "$(echo "$2" | sed "s/VERSION/$(echo "$version" | sed 's/\./\\\\./g')/")" "$1" || {
        echo "$1: no line is '$2' with VERSION $version" >&2
        status=1
    }
}
states CHANGELOG.md '^## VERSION\>'
for page in README.md BUILD.md; do
    if others=$(grep -onE '\<v[0-9]+(\.[0-9]+){2}\>' $page | grep -v ":v$version\$"); then
        echo "$page: names other versions than v$version:" $others >&2
        status=1
    fi
done
states packaging/debian/changelog '^tribox (VERSION-'
states packaging/vcpkg/vcpkg.json '^  "version": "VERSION",$'
states packaging/rust/Cargo.toml '^version = "VERSION"$'
states packaging/conan/conanfile.py '^    version = "VERSION"$'
states packaging/conan/conanfile.py '/tribox-VERSION.tar.xz"'
states packaging/homebrew/tribox.rb '/tribox-VERSION.tar.xz"$'
states packaging/conda/meta.yaml '^  version: VERSION$'
states packaging/conda/meta.yaml '/tribox-VERSION.tar.xz$'
states packaging/debian/control "^Package: libtribox${version%%.*}\$"
exit $status
