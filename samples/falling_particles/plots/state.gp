# state.csv over time: gnuplot -c state.gp state.csv > state.svg
# Height needs gravity, and leaks are drawn where there are any.
set encoding utf8
set micro
set datafile separator ","
largest(name, previous) = column(name) > previous ? column(name) : previous
height = 0; kinetic = 0; lost = 0; gained = 0; leaked = 0
set table $unused
plot ARG1 using (height = largest("kinetic_height_m", height), kinetic = largest("largest_kinetic_energy_J", kinetic), \
                 lost = largest("energy_lost_J", lost), gained = largest("energy_gained_J", gained), \
                 leaked = largest("bodies_leaked", leaked)) with table
unset table
# A logarithmic axis has no place for what is not positive.
positive(name) = column(name) > 0 ? column(name) : NaN

panels = 1 + (height > 0) + (kinetic > 0) + (leaked > 0)
set terminal svg size 900,60 + 260 * panels font "sans-serif,15" background "white"
set grid linecolor rgb "#d0d0d0"
set border 3
set tics nomirror
set key above right samplen 2 maxrows 1
set style data lines
set lmargin 12
set rmargin 3
set xrange [0:*]
set format x ""
drawn = 0

set multiplot layout panels,1
if (leaked > 0) {
  drawn = drawn + 1
  set ylabel "leaked grains"
  set yrange [0:*]
  plot ARG1 using "time_s":"bodies_leaked" with steps linewidth 2.5 linecolor rgb "#d55e00" notitle
}
drawn = drawn + 1
if (drawn == panels) { set format x "%g"; set xlabel "time, s" }
set ylabel "overlap"
set format y "%.0s %cm"
set yrange [0:*]
plot ARG1 using "time_s":"deepest_contact_of_all_steps_m" with steps linewidth 2 dashtype 2 linecolor rgb "#0072b2" title "deepest so far", \
     "" using "time_s":"deepest_contact_m" linewidth 2.5 linecolor rgb "#d55e00" title "deepest now"
set logscale y
set yrange [*:*]
if (height > 0) {
  drawn = drawn + 1
  if (drawn == panels) { set format x "%g"; set xlabel "time, s" }
  set ylabel "kinetic height"
  plot ARG1 using "time_s":(positive("kinetic_height_m")) linewidth 2.5 linecolor rgb "#d55e00" notitle
}
if (kinetic > 0) {
  set format x "%g"
  set xlabel "time, s"
  set ylabel "energy"
  set format y "%.0s %cJ"
  plot ARG1 using "time_s":(positive("energy_lost_J")) linewidth 2.5 linecolor rgb "#000000" title lost > 0 ? "lost" : "", \
       "" using "time_s":(positive("energy_gained_J")) linewidth 2.5 dashtype 2 linecolor rgb "#0072b2" title gained > 0 ? "gained" : "", \
       "" using "time_s":(positive("largest_kinetic_energy_J")) linewidth 2.5 linecolor rgb "#d55e00" title "largest kinetic"
}
unset multiplot
