# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 480,400 background "white"
set datafile separator ","
set key top left
set grid
set xrange [60:110]
set yrange [60:110]
set xlabel "published flow, g/s"
set ylabel "flow of 5.6 mm of the slot, g/s"
plot x with lines linecolor "grey" title "equal", \
     ARG1 skip 1 using (strcol(1) eq "periodic" ? $7 : NaN):4:5 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black" title "a slice that repeats", \
     ARG1 skip 1 using (strcol(1) eq "walls" ? $7 : NaN):4:5 with yerrorbars pointtype 6 pointsize 0.9 linecolor "red" title "between walls"
