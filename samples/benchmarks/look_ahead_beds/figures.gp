# The figure for a table written by `look_ahead_beds --csv`:
#   gnuplot -c samples/benchmarks/look_ahead_beds/figures.gp beds.csv look_ahead_beds.svg
if (ARGC != 2) { print "usage: gnuplot -c figures.gp beds.csv look_ahead_beds.svg"; exit status 2 }
set datafile separator ","
set datafile missing NaN
set terminal svg size 960,400 font "sans-serif,13" background "white"
set output ARG2
set grid
set logscale xy
set format x "10^{%T}"
set xlabel "deepest overlap, smallest half-axes"
set key top right samplen 2 font ",11"
sweeps = "'plain 40' 'ahead 40' 'ahead 100' 'ahead 250' 'Bullet 40'"
colours = "#cc0000 #6fa8dc #0b5394 #351c75 #000000"
overlap(exponent, sweep) = strcol(1)." ".strcol(4) eq sweep && column(3) == exponent ? column(6) : NaN
set multiplot layout 1,2
do for [exponent in "2 8"] {
  set title exponent eq "2" ? "600 ellipsoids" : "600 boxy grains, exponent 8"
  set ylabel exponent eq "2" ? "processor time of a simulated second, s" : ""
  shown = exponent eq "2" ? "1 2 3 4 5" : "1 3 4"
  plot for [k in shown] ARG1 skip 1 using (overlap(exponent + 0, word(sweeps, k + 0))):8 with linespoints linewidth 1.5 pointtype 7 \
    pointsize 0.6 linecolor rgb word(colours, k + 0) title word(sweeps, k + 0)." iterations"
}
unset multiplot
