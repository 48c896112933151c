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
states BUILD.md 'GIT_TAG vVERSION\>'
states BUILD.md 'release.sh vVERSION '
states packaging/debian/changelog '^tribox (VERSION-'
states packaging/vcpkg/vcpkg.json '^  "version": "VERSION",$'
states packaging/rust/Cargo.toml '^version = "VERSION"$'
states packaging/conda/meta.yaml '^  version: VERSION$'
states packaging/conda/meta.yaml '/tribox-VERSION.tar.xz$'
states packaging/debian/control "^Package: libtribox${version%%.*}\$"
exit $status
