#!/bin/sh
# Measures accuracy against speed and draws it: chart.sh PROGRAM SCRIPT FOLDER [ARGUMENT...]
# Leaves accuracy.txt, .csv, .json, .svg and trade.svg in the folder; arguments go to the program.
set -eu
program=$1 script=$2 folder=$3
shift 3
"$program" --csv "$folder/accuracy.csv" --json "$folder/accuracy.json" "$@" >"$folder/accuracy.txt"
gnuplot -c "$script" "$folder/accuracy.csv" "$folder/accuracy.svg"
gnuplot -c "$(dirname "$script")/trade.gp" "$folder/accuracy.csv" "$folder/trade.svg"
echo "$folder/accuracy.txt .csv .json .svg and trade.svg are written"
