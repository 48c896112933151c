# order.gp - each order's time over that of the fastest fixed order, a line for each scene, EXACT, of the widest kernel alone.
#   gnuplot -c order.gp order.csv OUT.svg   order.csv: of order_sweep.py, of which the first size is drawn
csv = ARG1
set datafile separator ","

where = "awk -F, '!/^#/ && $8 == \"all\" && $7 == \"exact\" { if (!size) { size = $2; kernel = $5 } if ($2 == size && $5 == kernel)"
scenes = system(sprintf("%s if (!seen[$1]++) print $1 }' '%s'", where, csv))
kernel = system(sprintf("%s { print $5; exit } }' '%s'", where, csv))

# What the scenes are: order.md says more.
about(scene) = scene eq "paper" ? "the paper's: at random, box 1" : scene eq "sparse" ? "small, scattered: nearly all miss" : \
    scene eq "sorted" ? "the same in spatial order" : scene eq "hit" ? "all overlap" : \
    scene eq "grazing" ? "one edge axis alone separates" : scene eq "plane" ? "the plane alone separates" : \
    scene eq "miss-x" ? "all miss on x" : scene eq "miss-z" ? "all miss on z" : scene eq "octree" ? "octree of a torus" : \
    scene eq "change" ? "half sparse, half plane" : scene[1:4] eq "box-" ? "at random, box " . scene[5:*] : "octree of " . scene

lines = words(scenes)
width = 980.0
height = 25.0 * lines + 120
set terminal svg size width, height background rgb '#ffffff' noenhanced font 'DejaVu Sans,12'
set output ARG2
set border 1 lc rgb "#606060"
set tics nomirror scale 0.5 textcolor rgb "#303030"
set grid xtics lc rgb "#e4e4e4" lw 1
set key off
set lmargin at screen 300 / width
set rmargin at screen 950 / width
set tmargin at screen 1 - 62 / height
set bmargin at screen 48 / height
set logscale x
set xrange [0.6 : 12]
set xtics ("0.7" 0.7, "1" 1, "1.5" 1.5, "2" 2, "3" 3, "5" 5, "10" 10)
set yrange [-0.7 : lines - 0.3]
set ytics () scale 0
set xlabel "time, relative to the fastest fixed order" offset 0, 0.4
set label 1 sprintf("No fixed order suits every scene (kernel %s, EXACT, one thread)", kernel) at screen 20 / width, \
    screen 1 - 20 / height left font ",14"
colours = "#56B4E9 #E69F00 #CC79A7 #000000"
colours = "#56B4E9 #E69F00 #CC79A7 #000000"
key_at(x) = x / width
key_y = 1 - 46 / height
set label 2 "box normals first: 123, 132" at screen key_at(20), screen key_y offset 1, 0 point pt 7 ps 0.7 lc rgb "#56B4E9"
set label 3 "plane first: 213, 231" at screen key_at(260), screen key_y offset 1, 0 point pt 7 ps 0.7 lc rgb "#E69F00"
set label 4 "edges first: 312, 321" at screen key_at(450), screen key_y offset 1, 0 point pt 7 ps 0.7 lc rgb "#CC79A7"
set label 5 "the default" at screen key_at(650), screen key_y offset 1, 0 point pt 7 ps 0.8 lc rgb "#000000"
do for [s = 1:lines] {
    set ytics add (about(word(scenes, s)) lines - s)
}
# The points of a group: time over the fastest, and the line. Orders are told by their first digit; the default is 0.
points(group) = sprintf("< %s { if (!seen[$1]++) n++; if (int($9 / 100) == %d) print $11 \",\" n } }' '%s'", where, group, csv)
plot for [g = 1:4] points(g % 4) using 1:(lines - $2) with points pt 7 ps (g == 4 ? 0.8 : 0.7) lc rgb word(colours, g)
