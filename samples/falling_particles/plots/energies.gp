# energies.csv over time: gnuplot -c energies.gp energies.csv > energies.svg
set terminal svg size 900,640 font "sans-serif,15" background "white"
set encoding utf8
set micro
set datafile separator ","
set grid linecolor rgb "#d0d0d0"
set border 3
set tics nomirror
set key above right samplen 2 maxrows 1
set style data lines
set lmargin 12
set rmargin 3
set xrange [0:*]

set multiplot layout 2,1
set format x ""
set ylabel "energy"
set format y "%.0s %cJ"
plot ARG1 using "time_s":"total_J" linewidth 6 linecolor rgb "#b0b0b0" title "total", \
     "" using "time_s":"potential_J" linewidth 2.5 dashtype 2 linecolor rgb "#0072b2" title "potential", \
     "" using "time_s":"kinetic_J" linewidth 2.5 linecolor rgb "#d55e00" title "kinetic"
set format x "%g"
set xlabel "time, s"
set ylabel "contacts"
set format y "%g"
set yrange [0:*]
plot ARG1 using "time_s":"contacts" linewidth 2 linecolor rgb "#0072b2" notitle
unset multiplot
