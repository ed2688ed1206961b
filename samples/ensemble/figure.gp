# A quantity over a parameter: gnuplot -c figure.gp DATA X Y SCALE PERCENT > figure.svg. Blocks of DATA are lines, with intervals.
set terminal svg size 720,480 font "sans-serif,13" background "white" noenhanced
set xlabel ARG2
set ylabel sprintf("%s, %s %% intervals of the mean", ARG3, ARG5)
if (ARG4 eq "log") set logscale x
set key bottom right reverse Left
set grid
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
stats ARG1 using 1 nooutput
plot for [i = 0:STATS_blocks - 1] ARG1 index i using 1:2:3 with yerrorlines linewidth 1.5 pointtype 7 pointsize 0.5 title columnheader(1)
