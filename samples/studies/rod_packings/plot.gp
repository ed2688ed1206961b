# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 640,400 background "white"
set datafile separator ","
set key bottom right
set grid
set xrange [0.2:2.2]
set yrange [7:11]
set xlabel "length of the cylinder / diameter"
set ylabel "contacts of a rod, without rattlers"
plot 10 with lines dashtype 2 linecolor "grey" title "isostatic", \
     ARG1 skip 1 using 1:2:3 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black" title "that bear force", \
     ARG1 skip 1 using 1:11 with points pointtype 10 title "gaps up to 0.001 diameters", \
     ARG1 skip 1 using 1:12 with points pointtype 4 title "0.01 diameters"
