# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 480,400 background "white"
set datafile separator ","
set key top left
set grid
set xrange [10:32]
set yrange [10:32]
set xlabel "formula of Zhou et al. (2002), degrees"
set ylabel "heap, degrees"
plot x with lines linecolor "grey" title "equal", \
     ARG1 skip 1 using ($6 == 4 ? $9 : NaN):7:8 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black" title "slice of 4 diameters", \
     ARG1 skip 1 using ($6 == 8 ? $9 : NaN):7:8 with yerrorbars pointtype 6 pointsize 0.9 linecolor "red" title "8 diameters"
