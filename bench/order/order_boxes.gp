# Nanoseconds per pair by the size of the box, a panel for each kernel. chart, kernels: set by order_charts.py.
set terminal svg size 1100, 800 font "sans-serif,13" background "white"
set output chart.".svg"
orders = "123 132 213 231 312 321"
colours = "#1b9e77 #000000 #d95f02 #e6ab02 #7570b3 #e7298a"
set multiplot layout 2, 2 title "The paper's triangles against boxes of 0.01 to 4, EXACT; dotted: the share that overlaps" font ",15"
set logscale x
set xrange [0.008:5]
set xlabel "box size"
set ylabel "ns per pair"
set yrange [0:*]
set y2range [0:1]
set y2tics 0.25
set ytics nomirror
set y2label "share that overlaps" textcolor "#888888"
set grid ytics linecolor "#dddddd"
do for [k = 1:words(kernels)] {
    if (k == 1) { set key bottom center maxrows 3 samplen 2 font ",11" } else { unset key }
    set label 1 word(kernels, k) at graph 0.97, 0.06 right font ",14"
    plot for [o = 1:6] "boxes_".word(kernels, k).".dat" using 1:(column(o + 2)) with linespoints pointtype 7 pointsize 0.4 \
             linewidth 1.5 linecolor rgb word(colours, o) title word(orders, o), \
         "boxes_".word(kernels, k).".dat" using 1:2 axes x1y2 with lines dashtype 3 linecolor "#888888" notitle
}
unset multiplot
