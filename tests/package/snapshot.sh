# snapshot.sh - read by the scripts beside it: a commit of the source tree as it lies, changes that are not committed included.
# snapshot ROOT REPOSITORY; the test is skipped where there is no git, or where the tree is not a clone.

snapshot() {
    if ! command -v git >/dev/null || ! test -e "$1/.git" || ! git -C "$1" rev-parse --verify -q HEAD >/dev/null 2>&1; then
        echo "the tree is not a git clone: skipped"
        exit 77
    fi
    mkdir -p "$2"
    (cd "$1" && git ls-files -z --cached --others --exclude-standard) | (cd "$1" && xargs -0 ls -d 2>/dev/null) |
        tar -c -C "$1" -T - -f - | tar -x -C "$2" -f -
    git -C "$2" init -q -b main
    git -C "$2" add -A
    GIT_AUTHOR_DATE='2000-01-01T00:00:00Z' GIT_COMMITTER_DATE='2000-01-01T00:00:00Z' \
        git -C "$2" -c user.name=test -c user.email=test@localhost -c commit.gpgsign=false commit -q -m 'The tree as it lies'
}
