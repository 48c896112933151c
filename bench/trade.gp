# trade.gp - what EXACT costs and what FAST loses, a line for each scene and mesh, of the widest kernel alone.
#   gnuplot -c trade.gp FILE.csv OUT.png   FILE.csv: of tribox-bench sweep --csv
csv = ARG1
set datafile separator ","

scenes = system(sprintf("awk -F, '$3 == \"all\" && !seen[$4]++ { print $4 }' '%s'", csv))
widest = system(sprintf("awk -F, '$2 == \"fast\" && $3 == \"all\" { print $1; exit }' '%s'", csv))
number(scene, accuracy, column) = real(system(sprintf( \
    "awk -F, '$4 == \"%s\" && $3 == \"all\" && $1 == \"%s\" && $2 == \"%s\" { print %s }' '%s'", scene, widest, accuracy, column, csv)))

# What the scenes of the benchmark are.
about(scene) = scene eq "paper" ? "the paper's: triangles at random" : scene eq "sparse" ? "small, scattered: nearly all miss" : \
    scene eq "cad" ? "CAD on a grid of 1/4: exact ties" : scene eq "cad-tenths" ? "CAD on a grid of 1/10: rounded ties" : \
    scene eq "touching" ? "nearly all touch the box" : scene eq "touching-ulp" ? "all an ulp from touching" : \
    scene eq "offset" ? "at random, far from the origin" : scene eq "needles" ? "needles, an edge of a few floats" : \
    scene eq "caps" ? "caps, a corner on the far edge" : scene eq "thin" ? "slivers that pierce the box" : "mesh: " . scene
errors_text(n) = n <= 0 ? "none" : n < 1 ? "less than 1 in a million" : n < 100 ? sprintf("%.0f in a million", n) : sprintf(n < 10000 ? "%.2f %%" : "%.1f %%", n / 10000)

lines = words(scenes)
width = 980.0
height = 27.0 * lines + 120
set terminal pngcairo size 1.5 * width, 1.5 * height pointscale 1.8 linewidth 1.5 noenhanced font "DejaVu Sans,13"
set output ARG2
set border 1 lc rgb "#606060"
set tics nomirror scale 0.5 textcolor rgb "#303030"
set grid xtics lc rgb "#e4e4e4" lw 1
set key off
set lmargin at screen 260 / width
set rmargin at screen 770 / width
set tmargin at screen 1 - 62 / height
set bmargin at screen 48 / height
set logscale x
set xrange [0.25 : 64]
set xtics ("0.3" 0.3, "0.5" 0.5, "1" 1, "2" 2, "5" 5, "10" 10, "20" 20, "50" 50)
set yrange [-0.7 : lines - 0.3]
set ytics () scale 0
set xlabel "nanoseconds per triangle" offset 0, 0.4
set label 1 sprintf("What EXACT costs and what FAST loses (kernel %s, one thread)", widest) at screen 20 / width, \
    screen 1 - 20 / height left font ",16"
set label 2 "FAST" at screen 262 / width, screen 1 - 46 / height left offset 1, 0 point pt 7 ps 0.8 lc rgb "#E69F00"
set label 3 "EXACT" at screen 340 / width, screen 1 - 46 / height left offset 1, 0 point pt 7 ps 0.8 lc rgb "#0072B2"
set label 4 "wrong answers of FAST" at screen 790 / width, screen 1 - 46 / height left textcolor rgb "#303030"
do for [s = 1:lines] {
    scene = word(scenes, s)
    y = lines - s
    fast = number(scene, "fast", "$5")
    exact = number(scene, "exact", "$5")
    wrong = number(scene, "fast", "$11 + $12")
    most = fast > exact ? fast : exact
    set ytics add (about(scene) y)
    set arrow 10 + s from fast, y to exact, y nohead lw 3 lc rgb "#b8c4cc"
    set label 100 + s at fast, y point pt 7 ps 0.8 lc rgb "#E69F00"
    set label 200 + s at exact, y point pt 7 ps 0.8 lc rgb "#0072B2"
    set label 300 + s sprintf("%.1f times", exact / fast) at most, y left offset 1.2, 0 textcolor rgb "#606060"
    set label 400 + s errors_text(wrong) at screen 790 / width, first y left textcolor rgb (wrong <= 0 ? "#909090" : "#B04000")
}
plot -10 with lines lc rgb "#ffffff"
