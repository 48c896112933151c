# Which axis rejects first, stacked to 100 percent of the pairs, for the default order and the paper's. chart: set by order_charts.py.
set terminal svg size 1100, 760 font "sans-serif,13" background "white"
set output chart.".svg"
set multiplot layout 2, 1
set style data histograms
set style histogram rowstacked
set style fill solid 0.9 border linecolor "white"
set boxwidth 0.8
set yrange [0:100]
set ylabel "percent of the pairs"
set xtics rotate by -40 scale 0
set key outside right center vertical invert
names = "x y z plane edges overlap"
colours = "#08519c #3182bd #9ecae1 #fdae6b #de2d26 #d9d9d9"
do for [order in "132 312"] {
    set title "Order ".order.": the axis that rejects first"
    plot for [part = 1:6] "first_".order.".dat" using (column(part + 1)):xtic(1) linecolor rgb word(colours, part) title word(names, part)
}
unset multiplot
