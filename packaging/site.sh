#!/bin/sh
# Builds the documentation as a static site: packaging/site.sh FOLDER, which is new, or empty. It appears when it is whole.
# It takes python3, cmark-gfm and mandoc; where node and npm are, it has the page of examples/web, which also takes what that takes.
# PAGE=FILE.html takes a page that was built before, PAGE= leaves it out.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)

die() {
    echo "site.sh: $*" >&2
    exit 1
}

test $# -eq 1 || die "usage: packaging/site.sh FOLDER"
for program in python3 cmark-gfm mandoc; do
    command -v $program >/dev/null || die "there is no $program: install the package of that name"
done
folder=${1%/}
test ! -e "$folder" || rmdir "$folder" 2>/dev/null || die "$folder is there already: remove it, or name another folder"
parent=$(dirname "$folder")
mkdir -p "$parent"
work=$(mktemp -d "$parent/.site.XXXXXX")
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir "$work/site"

if test -z "${PAGE+set}" && command -v node >/dev/null && command -v npm >/dev/null; then
    TRIBOX_SOURCE=${TRIBOX_SOURCE:-index.html} TRIBOX_DOCUMENTS=index.html sh "$root/examples/web/build.sh" "$work/page.html"
    PAGE=$work/page.html
fi
if test -n "${PAGE-}"; then
    cp "$PAGE" "$work/site/try.html"
else
    echo "without the page of examples/web"
fi
python3 -B "$root/packaging/site/build.py" "$root" "$work/site"
mv "$work/site" "$folder"
