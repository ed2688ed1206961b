# The figures for a folder written by `accuracy_cost --atlas --out folder`:
#   gnuplot -c samples/benchmarks/accuracy_cost/figures.gp folder
if (ARGC != 1) { print "usage: gnuplot -c figures.gp folder"; exit status 2 }
folder = ARG1

set datafile separator ","
set datafile missing NaN
set grid
smallest = 1e-16  # where an error is 0
shown(error) = error > smallest ? error : smallest

# --- queries: error over time, one figure for each class of bodies ---

csv = folder."/query.csv"
class = 1; pose = 2; method = 3; time = 6; gap_error = 9  # columns
methods = "'hybrid' 'hybrid (warm)' 'Newton (Algorithm I)' 'fixed point (Algorithm II)' 'libccd GJK+EPA' 'libccd MPR' 'Bullet GJK+EPA (float)' 'FCL signed distance' 'Simbody MPR+Newton'"
colours = "#0b5394 #6fa8dc #cc0000 #e69138 #38761d #674ea7 #000000 #999999 #a64d79"
classes = "E M B O N"
class_titles = "'ellipsoids' 'exponents 1.3 to 5' 'exponents 6 to 20' 'exponents 1.1 to 1.3' 'needles'"
poses = "T S D N"
pose_titles = "'touching' '1 % overlap' '30 % overlap' '1 % apart'"

error_of(c, p, m) = strcol(class) eq c && strcol(pose) eq p && strcol(method) eq m ? shown(column(gap_error)) : NaN

set terminal svg size 960,720 font "sans-serif,13" background "white"
set logscale xy
set format x "10^{%T}"
do for [i = 1:words(classes)] {
  set output sprintf("%s/query_%s.svg", folder, word(classes, i))
  set multiplot layout 2,2 title sprintf("What each digit of the gap costs: %s", word(class_titles, i))
  set xrange [1e-16:1]
  set yrange [0.1:300]
  do for [k = 1:words(poses)] {
    set title word(pose_titles, k)
    set xlabel k > 2 ? "median error of the gap / smallest half-axis" : ""
    set ylabel k % 2 ? "median time, µs" : ""
    if (k == 2) { set key top left Left reverse samplen 2 font ",9" } else { unset key }
    plot for [j = 1:words(methods)] csv using (error_of(word(classes, i), word(poses, k), word(methods, j))):(1e6 * column(time)) \
      with linespoints linewidth 1.5 pointtype 7 pointsize 0.6 linecolor rgb word(colours, j) title word(methods, j)
  }
  unset multiplot
}

# --- colliders ---

csv = folder."/colliders.csv"
colliders = "dPlane dBox dCapsule dTriMesh"
methods = "'Supernormal' 'Supernormal (warm)' 'dConvex' 'dTriMesh'"
colours = "#0b5394 #6fa8dc #38761d #cc0000"
collider_error(p, m) = word(strcol(1), 1) eq p && strcol(2) eq m ? shown(column(7)) : NaN
set output folder."/colliders.svg"
set multiplot layout 2,2 title "A superellipsoid against ODE's geoms: exact, and as a polyhedron of 32 to 1922 vertices"
set yrange [0.01:1000]
do for [k = 1:words(colliders)] {
  set title word(colliders, k)
  set xlabel k > 2 ? "median error of the depth / smallest half-axis" : ""
  set ylabel k % 2 ? "median time of dCollide, µs" : ""
  if (k == 1) { set key top left Left reverse samplen 2 font ",10" } else { unset key }
  plot for [j = 1:words(methods)] csv using (collider_error(word(colliders, k), word(methods, j))):(1e6 * column(5)) \
    with linespoints linewidth 1.5 pointtype 7 pointsize 0.6 linecolor rgb word(colours, j) title word(methods, j)
}
unset multiplot

# --- scene: cost and accuracy of each form ---

set terminal svg size 960,420 font "sans-serif,13" background "white"
csv = folder."/scene_outcomes.csv"
forms = "'Supernormal' 'dConvex' 'dTriMesh' 'dBox'"
colours = "#0b5394 #38761d #cc0000 #e69138"
form_error(f) = strcol(1) eq f ? shown(column(17)) : NaN
set output folder."/outcomes.svg"
set multiplot layout 1,2 title "1000 grains"
set title "fall: tolerances 1e-1 to 1e-12; 32, 122, 482 vertices"
set key top left Left reverse samplen 1 font ",10"
set xrange [1e-7:10]
set yrange [1:1000]
set xlabel "error of the period of a rocking ellipsoid"
set ylabel "mean time of a step, ms"
plot for [j = 1:words(forms)] csv using (form_error(word(forms, j))):(1e3 * column(11)) \
  with linespoints linewidth 1.5 pointtype 7 pointsize 0.9 linecolor rgb word(colours, j) title word(forms, j)
csv = folder."/scene_forms.csv"
set title "settled: a step of the same bed"
unset logscale
set format x "%g"
set xrange [*:*]
set yrange [0:*]
set xlabel ""
set ylabel "ms"
set style data histograms
set style histogram rowstacked
set style fill solid 0.8
set boxwidth 0.7
set xtics rotate by -35 font ",9"
set key top left
set bmargin 8
plot csv every ::1 using (1e3 * column(7)):xticlabels(strcol(1)[1:1] eq "d" ? strcol(1)." ".strcol(2) : strcol(1)) linecolor rgb "#999999" title "broad phase", \
  "" every ::1 using (1e3 * column(8)) linecolor rgb "#0b5394" title "narrow phase", \
  "" every ::1 using (1e3 * (column(9) + column(10))) linecolor rgb "#e69138" title "quickstep"
unset multiplot
set xtics norotate
unset bmargin

# --- growth ---

set terminal svg size 720,480 font "sans-serif,13" background "white"
csv = folder."/scene_growth.csv"
spaces = "'hash' 'quadtree' 'sweep and prune' 'simple'"
of_space(s, k) = strcol(1) eq s ? 1e3 * column(k) : NaN
set output folder."/growth.svg"
set title "Time of a step over the number of grains: find the contacts (thick), and with quickstep (thin)"
set style data linespoints
set logscale xy
set xrange [400:25000]
set yrange [1:2000]
set xlabel "grains"
set ylabel "ms"
set key top left
set xtics (500, 1000, 2000, 4000, 8000, 20000) norotate
colours = "#0b5394 #38761d #cc0000 #999999"
plot for [j = 1:words(spaces)] csv using 2:(of_space(word(spaces, j), 6) + of_space(word(spaces, j), 7)) \
       linewidth 3 pointtype 7 pointsize 0.5 linecolor rgb word(colours, j) title word(spaces, j), \
     for [j = 1:words(spaces)] csv using 2:(of_space(word(spaces, j), 10)) \
       linewidth 1 pointtype 7 pointsize 0.4 linecolor rgb word(colours, j) notitle, \
     1.5e-3 * x**1.1 with lines linewidth 1 dashtype 2 linecolor rgb "#000000" title "N^{1.1}"
