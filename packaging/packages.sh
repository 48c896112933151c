#!/bin/sh
# Installs the Debian packages that are missing: packages.sh NAME ...
set -eu
missing=
for package; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
done
test -n "$missing" || exit 0
if ! command -v apt-get >/dev/null; then
    echo "install these packages (their names in Debian):$missing" >&2
    exit 1
fi
sudo=
test "$(id -u)" = 0 || sudo=sudo
$sudo apt-get update -qq
# shellcheck disable=SC2086
DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends $missing >/dev/null
