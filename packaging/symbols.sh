#!/bin/sh
# Prints the public functions, sorted, as the headers in include/ declare them: the only place where they are listed.
sed -n 's/^TRIBOX_API [^(]*[ *]\(tribox_[a-z0-9_]*\)(.*/\1/p' "$(dirname "$0")"/../include/*.h | LC_ALL=C sort
