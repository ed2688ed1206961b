# Error against time from `accuracy_cost --sweep sweep.csv`, one figure for each class of bodies:
#   gnuplot -c samples/accuracy_cost/figures.gp sweep.csv folder
if (ARGC != 2) { print "usage: gnuplot -c figures.gp sweep.csv folder"; exit status 2 }
csv = ARG1
folder = ARG2

set datafile separator ","
set datafile missing NaN
set terminal svg size 960,720 font "sans-serif,13" background "white"
set logscale xy
set format x "10^{%T}"
set xrange [1e-16:1]
set yrange [0.1:200]
set grid
unset key

# Columns of the file.
class = 1; pose = 2; method = 3; time = 6; gap_error = 9
smallest = 1e-16  # where the error is 0

methods = "'hybrid' 'hybrid (warm)' 'Newton (Algorithm I)' 'fixed point (Algorithm II)' 'libccd GJK+EPA' 'libccd MPR'"
colours = "#0b5394 #6fa8dc #cc0000 #e69138 #38761d #674ea7"
classes = "E M B"
class_titles = "'ellipsoids' 'exponents 1.3 to 5' 'exponents 6 to 20'"
poses = "S D N F"
pose_titles = "'1 % overlap' '30 % overlap' '1 % apart' 'far apart'"

error_of(c, p, m) = strcol(class) eq c && strcol(pose) eq p && strcol(method) eq m ? \
                    (column(gap_error) > smallest ? column(gap_error) : smallest) : NaN

do for [i = 1:words(classes)] {
  set output sprintf("%s/accuracy_cost_%s.svg", folder, word(classes, i))
  set multiplot layout 2,2 title sprintf("What each digit of the gap costs: %s", word(class_titles, i))
  do for [k = 1:words(poses)] {
    set title word(pose_titles, k)
    set xlabel k > 2 ? "median error of the gap / smallest half-axis" : ""
    set ylabel k % 2 ? "median time, µs" : ""
    if (k == 1) { set key top left Left reverse samplen 2 font ",10" } else { unset key }
    plot for [j = 1:words(methods)] csv using (error_of(word(classes, i), word(poses, k), word(methods, j))):(1e6 * column(time)) \
      with linespoints linewidth 1.5 pointtype 7 pointsize 0.4 linecolor rgb word(colours, j) title word(methods, j)
  }
  unset multiplot
}
