# index.gp - the chart of what the program peers measured: how long a box takes, by its size, for each who answers.
#   gnuplot -c index.gp FILE.csv OUT
# OUT ends in .svg or .png.
csv = ARG1
out = ARG2
set datafile separator ","
set datafile missing NaN # rows of others do not break a line
scenes = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' '%s'", csv))
title_of(scene) = scene[strlen(scene) - 3:] eq ".ply" ? scene[:strlen(scene) - 4] : scene

# In the order of the legend; colours fit for colour-blind readers. Lists are drawn through, "is there any" is dashed.
contestants = "linear CGAL Bullet Embree list CGAL_any any"
array titles[7] = ["tribox\\_overlap", "CGAL", "Bullet, float", "Embree, filtered", \
    "tribox\\_index\\_list", "CGAL do\\_intersect", "tribox\\_index\\_any"]
array colours[7] = [0x909090, 0xE69F00, 0xCC79A7, 0x009E73, 0x0072B2, 0xE69F00, 0x0072B2]
title_of_line(c) = titles[c]
colour_of(c) = colours[c]
dash_of(c) = c > 5 ? 2 : 1
width_of(c) = c == 5 || c == 7 ? 2.4 : 1.4
name_of(c) = word(contestants, c) eq "CGAL_any" ? "CGAL any" : word(contestants, c)
is_of(scene, c) = strcol("scene") eq scene && strcol("contestant") eq name_of(c)

set border 3 lc rgb "#606060"
set tics nomirror scale 0.5 textcolor rgb "#303030"
set grid xtics ytics lc rgb "#e4e4e4" lw 1
set key off
terminal(width, height) = sprintf("set terminal %s size %d, %d %s font 'DejaVu Sans,11'", \
    out[strlen(out) - 2:] eq "svg" ? "svg" : "pngcairo", width, height, "background rgb '#ffffff'")

columns = words(scenes) < 2 ? 1 : 2
lines = (words(scenes) + columns - 1) / columns
panel_width = 430.0; panel_height = 300.0; top = 40.0; bottom = 80.0
width = columns * panel_width + 20
height = lines * panel_height + top + bottom
eval terminal(width, height)
set output out
set multiplot
set label 1 "Triangles that overlap a box: microseconds a box, one thread" at screen 0.5, screen 1 - 18 / height center font ",14"
do for [c = 1:words(contestants)] {
    left = 40.0 + 210 * ((c - 1) % 4)
    right = left + 30
    base = c > 4 ? 18.0 : 42.0
    set arrow (10 + c) from screen left / width, screen base / height to screen right / width, screen base / height \
        nohead lw width_of(c) lc rgb colour_of(c) dt dash_of(c)
    set label 10 + c title_of_line(c) at screen (left + 36) / width, screen base / height
}
set logscale xy
unset mxtics
unset mytics
set xrange [0.08:62]
set xtics ("0.1" 0.1, "0.3" 0.3, "1" 1, "3" 3, "10" 10, "50" 50)
set format y "10^{%T}"
stats csv using (column("us")) name "US" nooutput
set yrange [US_min / 1.5 : US_max * 1.5]
do for [s = 1:words(scenes)] {
    scene = word(scenes, s)
    across = (s - 1) % columns
    down = (s - 1) / columns
    set lmargin at screen (across * panel_width + 75) / width
    set rmargin at screen ((across + 1) * panel_width + 10) / width
    set tmargin at screen 1 - (top + down * panel_height + 30) / height
    set bmargin at screen 1 - (top + (down + 1) * panel_height - 40) / height
    set title title_of(scene) noenhanced offset 0, -0.5 font ",12"
    set xlabel (s + columns > words(scenes) ? "edge of the box, percent of the greatest extent" : "") offset 0, 0.4
    set ylabel (across == 0 ? "us" : "")
    plot for [c = 1:words(contestants)] csv using (is_of(scene, c) ? 100 * column("part") : NaN):(column("us")) \
        with linespoints pt 7 ps 0.4 lw width_of(c) dt dash_of(c) lc rgb colour_of(c)
    unset label
    unset arrow
}
unset multiplot
