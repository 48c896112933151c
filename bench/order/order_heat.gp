# Order x scene for one kernel, a panel for each accuracy. All variables: order_charts.py.
panels = words(accuracies)
high = 150 + 170 * panels
set terminal svg size 210 + 48 * scenes, high font "sans-serif,12" background "white"
set output chart.".svg"
set multiplot layout panels, 1 margins screen 80.0 / (210 + 48 * scenes), 1 - 130.0 / (210 + 48 * scenes), 95.0 / high, 1 - 60.0 / high spacing 0, 30.0 / high
set label 1 title at screen 0.5, screen 1 - 25.0 / high center font ",14"
set palette defined (1 "#f7fbff", 1.1 "#fdd49e", 1.25 "#fc8d59", 1.5 "#d7301f")
set cbrange [1:1.5]
set cblabel "times the fastest"
unset key
set xrange [-0.5:scenes - 0.5]
set yrange [5.5:-0.5]
set ytics ("123" 0, "132" 1, "213" 2, "231" 3, "312" 4, "321" 5) scale 0
do for [panel = 0:panels - 1] {
    set ylabel word(accuracies, panel + 1) offset -0.5
    if (panel < panels - 1) { unset xtics } else { eval "set xtics (".names.") rotate by -40 offset -0.5, 0 scale 0" }
    plot chart.".dat" index panel using 1:2:3 with image pixels, \
         "" index panel using ($4 == 1 ? $1 : NaN):2:(sprintf("%.2f", $3)) with labels font ",10" textcolor "#000000", \
         "" index panel using ($4 == 0 ? $1 : NaN):2:(sprintf("(%.2f)", $3)) with labels font ",10" textcolor "#606060"
    unset label 1
}
unset multiplot
