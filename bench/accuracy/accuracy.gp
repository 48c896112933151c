# accuracy.gp - the chart of what the program accuracy measured.
#   gnuplot -c accuracy.gp FILE.csv OUT   a panel for each scene: speed against error, all kernels and accuracies
# OUT ends in .svg or .png.
csv = ARG1
out = ARG2
set datafile separator ","

# Names in the order of the file, of the rows with all axes.
names(column) = system(sprintf("awk -F, '!/^#/ && $4 == \"all\" && !seen[$%d]++ { print $%d }' '%s'", column, column, csv))
scenes = names(1)
kernels = names(5)
accuracies = "baseline fast conservative exact"

# A colour for each kernel, fit for colour-blind readers, and a mark for each accuracy.
colour_of(kernel) = kernel eq "avx512" ? 0x0072B2 : kernel eq "avx2" ? 0x009E73 : kernel eq "sse2" ? 0xE69F00 : \
    kernel eq "neon" ? 0x56B4E9 : kernel eq "scalar" ? 0xCC79A7 : 0x000000
mark_of(accuracy) = accuracy eq "fast" ? 8 : accuracy eq "conservative" ? 4 : accuracy eq "exact" ? 7 : 2
title_of(name) = name eq "fast" ? "FAST" : name eq "conservative" ? "CONSERVATIVE" : name eq "exact" ? "EXACT" : \
    name eq "baseline" ? "the paper's test" : name

# No error at all is a column of its own at the left, in which the accuracies stand side by side.
zero = -1.5
aside_of(accuracy) = accuracy eq "baseline" ? -0.45 : accuracy eq "fast" ? -0.15 : accuracy eq "conservative" ? 0.15 : 0.45
error_at(errors, accuracy) = errors > 0 ? log10(errors) : zero + aside_of(accuracy)
error = "error_at(column('missed_per_million') + column('untrue_per_million'), strcol('accuracy'))"
is_of(scene, kernel) = strcol("axes") eq "all" && strcol("scene") eq scene && strcol("kernel") eq kernel
is_mark(scene, kernel, accuracy) = is_of(scene, kernel) && strcol("accuracy") eq accuracy
stats csv using (strcol("axes") eq "all" ? column("ns_median") : NaN) name "NS" nooutput
stats csv using (strcol("axes") eq "all" ? @error : NaN) name "ERROR" nooutput
error_least = zero - 0.8
error_most = ERROR_max > 2.4 ? ERROR_max + 0.6 : 3
error_tics = "set xtics ('0' zero, '1' 0, '10' 1, '100' 2, '10^3' 3, '10^4' 4, '10^5' 5, '10^6' 6)"

set border 3 lc rgb "#606060"
set tics nomirror scale 0.5 textcolor rgb "#303030"
set grid xtics ytics lc rgb "#e4e4e4" lw 1
set object 1 rectangle from first error_least, graph 0 to first zero + 0.8, graph 1 fc rgb "#f2f2f2" fs noborder behind
set key off

terminal(width, height) = sprintf("set terminal %s size %d, %d %s font 'DejaVu Sans,11'", \
    out[strlen(out) - 2:] eq "svg" ? "svg" : "pngcairo", width, height, "background rgb '#ffffff'")

columns = words(scenes) < 3 ? words(scenes) : 3
lines = (words(scenes) + columns - 1) / columns
panel_width = 380.0; panel_height = 280.0; top = 40.0; bottom = 70.0
width = columns * panel_width + 20
height = lines * panel_height + top + bottom
eval terminal(width, height)
set output out
set multiplot
set label 1 "Speed against error, all thirteen axes, one thread" at screen 0.5, screen 1 - 18 / height center font ",14"
do for [k = 1:words(kernels)] {
    set label 10 + k title_of(word(kernels, k)) \
        at screen (75.0 + (k > 1 ? 75 : 0) + 90 * (k - 1)) / width, screen 22 / height offset 1.2, 0 \
        point pt (k == 1 ? mark_of("baseline") : 5) ps 1.2 lc rgb colour_of(word(kernels, k))
}
do for [a = 2:4] {
    set label 20 + a title_of(word(accuracies, a)) \
        at screen (width - 460 + 110 * (a - 2) + (a == 4 ? 60 : 0)) / width, screen 22 / height offset 1.2, 0 \
        point pt mark_of(word(accuracies, a)) ps 1.2 lc rgb "#404040"
}
set logscale y
set yrange [NS_min / 1.6 : NS_max * 1.6]
set xrange [error_least : error_most]
eval error_tics
do for [s = 1:words(scenes)] {
    scene = word(scenes, s)
    across = (s - 1) % columns
    down = (s - 1) / columns
    set lmargin at screen (across * panel_width + 75) / width
    set rmargin at screen ((across + 1) * panel_width + 10) / width
    set tmargin at screen 1 - (top + down * panel_height + 30) / height
    set bmargin at screen 1 - (top + (down + 1) * panel_height - 40) / height
    set title scene offset 0, -0.5 font ",12"
    set xlabel (s + columns > words(scenes) ? "errors in a million pairs (marks at 0 are spread)" : "") offset 0, 0.4
    set ylabel (across == 0 ? "ns per triangle" : "")
    plot for [k = 2:words(kernels)] csv using (is_of(scene, word(kernels, k)) ? @error : NaN):(column("ns_median")) \
             with lines lw 1 dt 3 lc rgb colour_of(word(kernels, k)), \
         for [k = 1:words(kernels)] for [a = 1:4] csv \
             using (is_mark(scene, word(kernels, k), word(accuracies, a)) ? @error : NaN):(column("ns_median")) \
             with points pt mark_of(word(accuracies, a)) ps 1.1 lw 1.6 lc rgb colour_of(word(kernels, k))
    unset label
}
unset multiplot
