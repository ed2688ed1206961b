# gnuplot -c plot.gp results.csv > figure.svg
set terminal svg size 640,400 background "white"
set datafile separator ","
set key top left
set grid
set xrange [0:*]
set yrange [0:*]
set xlabel "weight of the beans, N"
set ylabel "force on the floor, N"
plot x with lines linecolor "grey" title "weight", \
     ARG1 skip 1 using (strcol(2) eq "sinking" ? $3 : NaN):4:5 with yerrorbars pointtype 7 pointsize 0.7 linecolor "black" title "floor sinks", \
     ARG1 skip 1 using (strcol(2) eq "sinking" ? $3 : NaN):6 with points pointtype 2 linecolor "black" title "Janssen with its stress ratio", \
     ARG1 skip 1 using (strcol(2) eq "at rest" ? $3 : NaN):4:5 with yerrorbars pointtype 6 pointsize 0.9 linecolor "red" title "at rest", \
     ARG1 skip 1 using (strcol(2) eq "at rest" ? $3 : NaN):6 with points pointtype 1 linecolor "red" title "Janssen with its stress ratio"
