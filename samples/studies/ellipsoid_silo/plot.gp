# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 640,400 background "white"
set datafile separator ","
set key off
set logscale x
set xrange [0.3:2.5]
set xtics ("0.4" 0.4, "0.6" 0.6, "1" 1, "1.5" 1.5, "2" 2)
set grid
set xlabel "aspect ratio"
set ylabel "mass flow / that of spheres"
plot ARG1 skip 1 using 1:4 with lines linewidth 1 linecolor "grey", \
     ARG1 skip 1 using 1:4:5 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black"
