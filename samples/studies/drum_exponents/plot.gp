# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 640,400 background "white"
set datafile separator ","
set key off
set logscale x
set xrange [1.3:60]
set xtics ("1.5" 1.5, "2" 2, "3" 3, "5" 5, "10" 10, "50" 50)
set grid
set xlabel "exponent"
set ylabel "dynamic angle of repose, degrees"
plot ARG1 skip 1 using 1:2 with lines linewidth 1 linecolor "grey", \
     ARG1 skip 1 using 1:2:3 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black"
