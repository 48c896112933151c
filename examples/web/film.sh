#!/bin/sh
# Makes a short film of the page, for README.md: examples/web/film.sh OUT.webp. It takes chromium, ffmpeg and what build.sh takes.
set -eu
test $# -eq 1 || { echo 'usage: examples/web/film.sh OUT.webp' >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT
sh "$here/../../tests/page/run.sh" film "$pictures"
ffmpeg -v error -y -framerate 8 -i "$pictures/%03d.png" -vf scale=640:-1:flags=lanczos \
    -c:v libwebp_anim -quality 40 -compression_level 6 -loop 0 "$1"
