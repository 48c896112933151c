# Packets left after the first group, by lanes: a row for each scene, a panel for each group that may come first.
# chart, scenes, lanes: set by order_charts.py.
height = 150 + 34 * scenes
set terminal svg size 1100, height font "sans-serif,13" background "white"
set output chart.".svg"
set multiplot title "Percent of the packets in which a pair is left after the first group of axes" font ",15"
colours = "#9ecae1 #6baed6 #2171b5 #08306b"
set border 1 linecolor "#606060"
set xrange [0:100]
set yrange [scenes - 0.4:-0.6]
set xtics 0, 50, 100 nomirror scale 0.5
unset ytics
set grid xtics linecolor "#dddddd"
set style fill solid 1 noborder
set tmargin at screen 1 - 62.0 / height
set bmargin at screen 90.0 / height
thickness = 0.8 / words(lanes)
do for [panel = 1:3] {
    order = word("123 213 312", panel)
    left = 0.16 + 0.285 * (panel - 1)
    set lmargin at screen left
    set rmargin at screen left + 0.25
    set title (panel == 1 ? "box normals first" : panel == 2 ? "plane first" : "edges first") font ",13" offset 0, -0.5
    if (panel == 2) { set key at screen 0.55, 16.0 / height center bottom horizontal maxrows 1 samplen 1.5 width -2 } else { unset key }
    plot for [l = 1:words(lanes)] "left_".order.".dat" \
             using (column(l + 1) / 2):($0 - 0.4 + (l - 0.5) * thickness):(column(l + 1) / 2):(thickness / 2) with boxxyerror \
             linecolor rgb word(colours, l) title word(lanes, l).(word(lanes, l) eq "1" ? " lane" : " lanes"), \
         "left_".order.".dat" using (0):0:(panel == 1 ? stringcolumn(1) : "") with labels right offset -0.8, 0 notitle
}
unset multiplot
