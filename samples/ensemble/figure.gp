# A quantity over a parameter: gnuplot -c figure.gp DATA X Y SCALE PERCENT > figure.svg. Blocks of DATA are lines, with intervals.
set terminal svg size 720,480 font "sans-serif,13" background "white" noenhanced
stats ARG1 using 1 nooutput
stats ARG1 using 3 name "WIDTH" nooutput
# A point of one seed has no interval.
has_intervals = WIDTH_max > 0
set xlabel ARG2
set ylabel has_intervals ? sprintf("%s, %s %% intervals of the mean", ARG3, ARG5) : ARG3
if (ARG4 eq "log") set logscale x
set key outside top center horizontal reverse Left
set grid
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
if (has_intervals) {
  plot for [i = 0:STATS_blocks - 1] ARG1 index i using 1:2:3 with yerrorlines linewidth 1.5 pointtype 7 pointsize 0.5 title columnheader(1)
} else {
  plot for [i = 0:STATS_blocks - 1] ARG1 index i using 1:2 with linespoints linewidth 1.5 pointtype 7 pointsize 0.5 title columnheader(1)
}
