# Nanoseconds per pair by the size of the box, a panel for each kernel. chart, kernels: set by order_charts.py.
set terminal svg size 1100, 840 font "sans-serif,13" background "white"
set output chart.".svg"
orders = "123 132 213 231 312 321"
colours = "#1b9e77 #000000 #d95f02 #e6ab02 #7570b3 #e7298a"
set multiplot layout 2, 2 margins screen 0.07, 0.95, 0.17, 0.90 spacing screen 0.11, 0.12 \
    title "The paper's triangles against boxes of 0.01 to 4, EXACT; dotted: the share that overlaps" font ",15"
set border 11 linecolor "#606060"
set logscale x
set xrange [0.008:5]
set xtics nomirror
set xlabel "box size" offset 0, 0.5
set ylabel "ns per pair" offset 1, 0
set yrange [0:*]
set y2range [0:1]
set y2tics 0.25 textcolor "#888888"
set ytics nomirror
set grid ytics linecolor "#dddddd"
do for [k = 1:words(kernels)] {
    if (k == 1) { set key at screen 0.5, screen 0.01 center bottom horizontal maxrows 2 samplen 2 } else { unset key }
    set title word(kernels, k) font ",14" offset 0, -0.6
    plot for [o = 1:6] "boxes_".word(kernels, k).".dat" using 1:(column(o + 2)) with linespoints pointtype 7 pointsize 0.4 \
             linewidth 1.5 linecolor rgb word(colours, o) title "order ".word(orders, o), \
         "boxes_".word(kernels, k).".dat" using 1:2 axes x1y2 with lines dashtype 3 linecolor "#888888" notitle
}
unset multiplot
