#!/bin/sh
# Runs a program for Windows, with wine's own folder in that of the build: wine.sh FOLDER PROGRAM [ARGUMENT...]
WINEPREFIX=$1/wine WINEDEBUG=-all DISPLAY='' WINEDLLOVERRIDES=mscoree,mshtml= LC_ALL=C.UTF-8
export WINEPREFIX WINEDEBUG DISPLAY WINEDLLOVERRIDES LC_ALL
shift
exec /usr/lib/wine/wine64 "$@"
