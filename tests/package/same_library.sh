# same_library.sh - read by the scripts beside it: whether two builds of the libraries are the same, byte for byte.
# same_library FOLDER VERSION BUILD BUILD; what was built in FOLDER may not have its path.

same_library() {
    for library in libtribox.a "libtribox.so.$2"; do
        cmp "$3/src/$library" "$4/src/$library" || exit 1
        if grep -q "$1" "$3/src/$library"; then
            echo "$library has the folder that it was built in" >&2
            exit 1
        fi
        echo "${3##*/}: $library is the same"
    done
}
