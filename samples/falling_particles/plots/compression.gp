# compression.csv over time: gnuplot -c compression.gp compression.csv > compression.svg
set terminal svg size 1000,680 font "sans-serif,15" background "white"
set encoding utf8
set micro
set datafile separator ","
set grid linecolor rgb "#d0d0d0"
set border 3
set tics nomirror
set key above right samplen 2 maxrows 1
set style data lines
set lmargin 11
set rmargin 3
set tmargin 2.5
set xrange [0:*]
set format x "%g"

set multiplot layout 2,2
set ylabel "volume fraction"
plot ARG1 using "time_s":"volume_fraction" linewidth 2.5 linecolor rgb "#d55e00" title "in the cell", \
     "" using "time_s":"volume_fraction_at_contact" linewidth 2.5 dashtype 2 linecolor rgb "#0072b2" title "at contact"
set ylabel "side of the cell"
set format y "%.0s %cm"
plot ARG1 using "time_s":"cell_side_m" linewidth 2.5 linecolor rgb "#0072b2" notitle
set xlabel "time, s"
set ylabel "contacts per grain"
set format y "%g"
set yrange [0:*]
plot ARG1 using "time_s":"contacts_per_grain" linewidth 2.5 linecolor rgb "#0072b2" notitle
set ylabel "mean overlap, relative"
set logscale y
set yrange [*:*]
set format y "10^{%T}"
plot ARG1 using "time_s":"mean_overlap" linewidth 2.5 linecolor rgb "#d55e00" title "measured", \
     "" using "time_s":"target_overlap" linewidth 2.5 dashtype 2 linecolor rgb "#000000" title "target"
unset multiplot
