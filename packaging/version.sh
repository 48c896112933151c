#!/bin/sh
# Prints the version that include/tribox.h states: the only place where it is written.
sed -n 's/^#define TRIBOX_VERSION_[A-Z]* *\([0-9][0-9]*\)$/\1/p' "$(dirname "$0")/../include/tribox.h" | paste -s -d . -
