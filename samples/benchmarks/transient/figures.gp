# The figures of a folder in which `transient --csv transient.csv --motion motion.csv` has written:
#   gnuplot -c samples/benchmarks/transient/figures.gp FOLDER
if (ARGC != 1) { print "usage: gnuplot -c figures.gp FOLDER"; exit status 2 }
cost = ARG1."/transient.csv"
motion = ARG1."/motion.csv"
set datafile separator ","
set datafile missing NaN
set grid
classes = "E M B N"
titles = "'ellipsoids' 'exponents 1.3 to 5' 'exponents 6 to 20' 'needles'"
is_shown(class) = strcol(1) eq class && column(2) == 64 && strcol(3) eq "elastic" && column(4) == 0.001

# Time of a simulated second against failures of all kinds, of queries for the same poses.
set terminal svg size 960,760 font "sans-serif,13" background "white"
set output ARG1."/cost.svg"
set logscale xy
set format y "10^{%T}"
set xrange [0.01:100]
set yrange [0.5:2e6]
failures(n) = 1e6 * (column(10) + column(11) + column(12) + column(13)) / column(7) + 1
families = "'hybrid' 'Newton (Algorithm I)' 'fixed point (Algorithm II)' '(1)' '(2)' '(3)' '(4)' 'libccd GJK+EPA 1e-6' 'Bullet' 'dTriMesh' 'hulls'"
names = "'hybrid' 'Newton (Algorithm I)' 'fixed point (Algorithm II)' 'implicit points (1)' 'normal angles (2)' 'midway point (3)' 'contact space (4)' 'libccd GJK+EPA 1e-6' 'Bullet' 'dTriMesh' 'hulls'"
colours = "#000000 #cc0000 #e69f00 #56b4e9 #0072b2 #009e73 #cc79a7 #8f6b32 #999999 #b0b000 #6a3d9a"
is_of(family, start) = strstrt(strcol(5), family) > 0 && strcol(6) eq start && strstrt(strcol(5), "moved") == 0
set multiplot layout 2,2
do for [c = 1:4] {
  set title word(titles, c)
  set ylabel (c % 2 == 1 ? "failures of a million queries, and one" : "")
  set xlabel (c > 2 ? "queries of a simulated second, s of the processor" : "")
  if (c == 1) { set key top right font ",10" samplen 1 } else { unset key }
  plot for [k = 1:words(families)] cost skip 1 using (is_shown(word(classes, c)) && is_of(word(families, k), "cold") ? column(8) / column(18) : NaN):(failures(0)) \
         with points pointtype 6 pointsize 0.7 linewidth 1.5 linecolor rgb word(colours, k) title word(names, k), \
       for [k = 1:words(families)] cost skip 1 using (is_shown(word(classes, c)) && is_of(word(families, k), "warm") ? column(8) / column(18) : NaN):(failures(0)) \
         with points pointtype 7 pointsize 0.7 linecolor rgb word(colours, k) notitle
}
unset multiplot

# Distance from the certified motion against time.
set terminal svg size 960,840 font "sans-serif,13" background "white"
set output ARG1."/motion.svg"
unset logscale x
set xrange [0:1]
set yrange [1e-14:1e3]
methods = "'certified moved by 1e-12 m' 'hybrid at 1e-14' 'hybrid' 'Newton (Algorithm I)' 'fixed point (Algorithm II)' 'implicit points (1)' 'normal angles (2)' 'midway point (3)' 'contact space: distance (4)' 'libccd GJK+EPA 1e-6' 'dTriMesh (1922 vertices)'"
lines = "#bbbbbb #000000 #000000 #cc0000 #e69f00 #56b4e9 #0072b2 #009e73 #cc79a7 #8f6b32 #b0b000"
set multiplot layout 2,2 margins 0.09, 0.98, 0.18, 0.95 spacing 0.09, 0.1
do for [c = 1:4] {
  set title word(titles, c)
  set ylabel (c % 2 == 1 ? "largest distance, smallest half-axes" : "")
  set xlabel (c > 2 ? "time, s" : "")
  if (c == 4) { set key at screen 0.97, screen 0.09 maxcols 4 Left reverse samplen 2 font ",12" } else { unset key }  # below the curves
  plot for [k = 1:words(methods)] motion skip 1 using (is_shown(word(classes, c)) && strcol(5) eq word(methods, k) && strcol(6) eq "cold" ? column(7) : NaN):8 \
    with lines linewidth 1.5 dashtype 1 + (k == 3) linecolor rgb word(lines, k) title word(methods, k)
}
unset multiplot
