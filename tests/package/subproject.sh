#!/bin/sh
# A meson project finds its subproject tribox by dependency('tribox'), and would build the library alone:
# subproject.sh tree|wrap-git|wrap-file ROOT
#   tree       the source tree lies under subprojects/; this one is built, the others have the same files
#   wrap-git   a wrap file names a git repository
#   wrap-file  a wrap file names the tarball of a release, and its hash
. "$(dirname "$0")/parts.sh"
how=$1 root=$2

cp -R "$here/consumer" "$work/consumer"
subprojects=$work/consumer/subprojects
mkdir "$subprojects"
version=$("$root/packaging/version.sh")

case $how in
tree)
    ln -s "$root" "$subprojects/tribox"
    ;;
wrap-git)
    snapshot "$root" "$work/repository"
    printf '%s\n' '[wrap-git]' "url = file://$work/repository" 'revision = main' 'depth = 1' >"$subprojects/tribox.wrap"
    ;;
wrap-file)
    snapshot "$root" "$work/tribox-$version"
    git -C "$work/tribox-$version" archive --prefix="tribox-$version/" -o "$work/tribox-$version.tar.gz" main
    hash=$(sha256sum "$work/tribox-$version.tar.gz")
    printf '%s\n' '[wrap-file]' "directory = tribox-$version" "source_url = file://$work/tribox-$version.tar.gz" \
        "source_filename = tribox-$version.tar.gz" "source_hash = ${hash%% *}" >"$subprojects/tribox.wrap"
    ;;
esac
test "$how" = tree || printf '\n%s\n' '[provide]' 'dependency_names = tribox' >>"$subprojects/tribox.wrap"

# Not optimised, and without the kernels that take the longest to compile: how the files are found is asked here.
"$MESON" setup "$work/build" "$work/consumer" -Doptimization=0 --force-fallback-for=tribox \
    -Dc_args='-DTRIBOX_WITHOUT_SSE2 -DTRIBOX_WITHOUT_AVX2 -DTRIBOX_WITHOUT_AVX512'
! "$MESON" introspect --targets "$work/build" | grep -qE '/subprojects/tribox[^/"]*/(tools|python|bench|tests)/' ||
    die 'a project that uses tribox builds more of it than the library'
if test "$how" = tree; then
    "$MESON" test -C "$work/build" consumer
else
    fetched=$(dirname "$(ls "$subprojects"/*/meson_options.txt)")
    (cd "$root" && git ls-files --cached --others --exclude-standard) | while read -r file; do
        test ! -f "$root/$file" || cmp "$root/$file" "$fetched/$file" || exit 1
    done
fi
