# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 480,400 background "white"
set datafile separator ","
set key bottom right
set grid
set xrange [0:2.2]
set yrange [6:11]
set xlabel "length of the cylinder / diameter"
set ylabel "contacts of a rod, without rattlers"
plot 10 with lines dashtype 2 linecolor "grey" title "isostatic", \
     ARG1 skip 1 using ($2 == 4 ? $1 : NaN):3:4 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black" title "rattlers have fewer than 4", \
     ARG1 skip 1 using ($2 == 6 ? $1 : NaN):3:4 with yerrorbars pointtype 6 pointsize 0.9 linecolor "red" title "fewer than 6"
