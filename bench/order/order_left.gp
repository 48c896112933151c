# Packets left after the first group, by lanes, for each group that may come first. chart: set by order_charts.py.
set terminal svg size 1100, 900 font "sans-serif,13" background "white"
set output chart.".svg"
set multiplot layout 3, 1
set style data histograms
set style histogram clustered gap 1.5
set style fill solid 0.9 noborder
set yrange [0:105]
set ylabel "percent"
set xtics rotate by -40 scale 0
set grid ytics linecolor "#dddddd"
set key outside right center vertical
lanes = "1 4 8 16"
colours = "#bdd7e7 #6baed6 #3182bd #08306b"
do for [order in "123 213 312"] {
    set title "Packets with a pair left after the ".(order eq "123" ? "box normals" : order eq "213" ? "plane" : "edges")
    plot for [l = 1:4] "left_".order.".dat" using (column(l + 1)):xtic(1) linecolor rgb word(colours, l) \
             title word(lanes, l).(l == 1 ? " lane" : " lanes")
}
unset multiplot
