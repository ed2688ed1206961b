# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 640,400 background "white"
set datafile separator ","
set key bottom right
set logscale x
set xrange [250:1e5]
set grid
set xlabel "steps of the compression"
set ylabel "volume fraction"
plot 0.82 with lines dashtype 2 linecolor "grey" title "Delaney and Cleary 2010", \
     ARG1 skip 1 using ($1 == 0.03 ? $2 : NaN):3:4 with yerrorbars pointtype 7 pointsize 0.7 title "3 % of all speed lost a step", \
     ARG1 skip 1 using ($1 == 0.003 ? $2 : NaN):3:4 with yerrorbars pointtype 6 pointsize 0.7 title "0.3 %"
