#!/bin/sh
# packaging/release.sh makes the same files of a tag twice, and refuses what is no release: release.sh ROOT refusals|PART...
# Of the source archive: it has what is committed and nothing else, and the library that builds from it is that of a clone.
. "$(dirname "$0")/parts.sh"
root=$1
shift
export CCACHE_DISABLE=1 # or the second time would be a copy of the first
export OPTIMIZATION=0 DEB_BUILD_OPTIONS='noopt nocheck' LC_ALL=C

# refuses MESSAGE TAG FOLDER
refuses() {
    if packaging/release.sh "$2" "$3" >"$work/log" 2>&1 || ! grep -q "$1" "$work/log"; then
        cat "$work/log" >&2
        die "it does not say '$1'"
    fi
}

snapshot "$root" "$work/repository"
cd "$work/repository"
version=$(packaging/version.sh)
tag=v$version name=tribox-$version
refuses "no tag $tag" "$tag" "$work/new"
git tag "$tag"
git tag other
refuses "whose tag is $tag" other "$work/new"
mkdir "$work/full"
touch "$work/full/file"
refuses 'there already' "$tag" "$work/full"
touch forgotten
refuses 'in no commit' "$tag" "$work/new"
rm forgotten
echo >>README.md
refuses 'in no commit' "$tag" "$work/new"
git checkout -q README.md
test ! -e "$work/new" || die 'a folder is left where nothing was made'
test "$1" != refusals || exit 0

# Whatever the tree has got since the tag, wherever it lies, and whenever that is.
(umask 022 && PARTS="$*" packaging/release.sh "$tag" "$work/one")
sleep 1.1
git clone -q "$work/repository" "$work/another/clone"
cd "$work/another/clone"
git -c user.name=test -c user.email=test@localhost -c commit.gpgsign=false commit -q --allow-empty -m later
(umask 077 && PARTS="$*" TMPDIR=$work/another packaging/release.sh "$tag" "$work/two")
cd "$work"
diff -r one two || die 'twice is not the same'
(cd one && sha256sum -c --quiet SHA256SUMS)
test "$(ls one)" = "$({ sed 's/.*  //' one/SHA256SUMS; echo SHA256SUMS; } | sort)" ||
    die 'SHA256SUMS does not name all'
case " $* " in
*' two_files '*)
    python3 -m zipfile -l "one/$name-two-files.zip" | grep -cE "^$name-two-files/(tribox\.[ch]|LICENSE) " | grep -qx 3 ||
        die 'the zip of two files has not these and the licence'
    ;;
esac
case " $* " in
*' windows '*)
    python3 -m zipfile -l "one/$name-windows-x64.zip" >listed
    for file in bin/tribox.exe bin/libtribox-${version%%.*}.dll lib/libtribox.dll.a include/tribox.h LICENSE; do
        grep -q "^$name-windows-x64/$file " listed || die "the zip has no $file"
    done
    ;;
esac

mkdir unpacked
tar -x -C unpacked -f "one/$name.tar.xz"
git -C repository ls-files | sort >committed
(cd "unpacked/$name" && find . ! -type d | sed 's,^\./,,' | sort) | diff committed - >&2 ||
    die 'the source archive lacks (<) or adds (>) these files'
# The library wants a C compiler and meson: the CMake package needs no CMake to be made.
mkdir bin
printf '#!/bin/sh\necho "CMake was run" >&2\ntouch "%s"\nexit 1\n' "$work/asked" >bin/cmake
chmod +x bin/cmake
for source in "unpacked/$name" another/clone; do
    PATH=$work/bin:$PATH "$MESON" setup "$source/build" "$source" -Dtests=disabled -Dbench=disabled -Dtools=disabled \
        -Doptimization=0 >log
    test ! -e asked || die 'configuring the library runs CMake'
    "$MESON" compile -C "$source/build" >log
done
same_library "$work" "$version" "unpacked/$name/build" another/clone/build
"$MESON" install -C "unpacked/$name/build" --no-rebuild --quiet --destdir "$work/root"
test "$(find root -name tribox.h -o -name tribox.3 -o -name tribox.pc -o -name triboxConfig.cmake | wc -l)" = 4
cat one/SHA256SUMS
