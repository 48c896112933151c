#!/bin/sh
# Measures accuracy against speed and draws it: chart.sh PROGRAM SCRIPT FOLDER [ARGUMENT...]
# Leaves accuracy.txt, .csv, .json, .svg, .png, and accuracy_short.svg and .png in the folder; arguments go to the program.
set -eu
program=$1 script=$2 folder=$3
shift 3
"$program" --csv "$folder/accuracy.csv" --json "$folder/accuracy.json" "$@" >"$folder/accuracy.txt"
for ending in svg png; do
    gnuplot -c "$script" "$folder/accuracy.csv" "$folder/accuracy.$ending"
    gnuplot -c "$script" "$folder/accuracy.csv" "$folder/accuracy_short.$ending" short
done
echo "$folder/accuracy.txt .csv .json .svg .png and accuracy_short.svg .png are written"
