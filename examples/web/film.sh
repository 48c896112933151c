#!/bin/sh
# Makes a short film of the page, for README.md: examples/web/film.sh OUT.gif. It takes chromium, ffmpeg and what build.sh takes.
set -eu
test $# -eq 1 || { echo 'usage: examples/web/film.sh OUT.gif' >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT
sh "$here/../../tests/page/run.sh" film "$pictures"
colours='palettegen=max_colors=64:stats_mode=diff' use='paletteuse=dither=none:diff_mode=rectangle'
ffmpeg -v error -y -framerate 8 -i "$pictures/%03d.png" -filter_complex \
    "scale=640:-1:flags=lanczos,split[a][b];[a]$colours[c];[b][c]$use" "$1"
