# Time per step from `measure cost.csv`:
#   gnuplot -c samples/falling_particles/costs/effects_cost/figures.gp cost.csv figure.svg
if (ARGC != 2) { print "usage: gnuplot -c figures.gp cost.csv figure.svg"; exit status 2 }

set datafile separator ","
set terminal svg size 960,480 font "sans-serif,13" background "white"
set output ARG2
set title "Time per step of a bed of 250 grains, one effect at a time"
set ylabel "ms"
set yrange [0:*]
set style data histograms
set style histogram rowstacked
set style fill solid 0.9 border -1
set boxwidth 0.7
set grid ytics
set xtics rotate by 35 right nomirror font ",11"
set key top left

plot ARG1 skip 1 using (1e3 * $4):xtic(1) title "collision" linecolor rgb "#6fa8dc", \
     "" skip 1 using (1e3 * $2) title "effects' passes, contact joints" linecolor rgb "#e69138", \
     "" skip 1 using (1e3 * $3) title "solver" linecolor rgb "#0b5394"
