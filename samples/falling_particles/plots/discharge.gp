# discharge.csv over time, from a little before the first grain has passed the outlet until a little after the last:
#   gnuplot -c discharge.gp discharge.csv > discharge.svg
set terminal svg size 900,480 font "sans-serif,15" background "white"
set encoding utf8
set micro
set datafile separator ","
set grid linecolor rgb "#d0d0d0"
set border 11
set tics nomirror
set key above right samplen 2 maxrows 1
set lmargin 12
set rmargin 9

first = NaN
last = NaN
mass = 0
before = 0
# The times of the last line without a grain and of the first line with all.
note(time, now) = (now > 0 && first != first ? first = before : 0, now > mass ? (mass = now, last = time) : 0, before = time, now)
set terminal push
set table $unused
plot ARG1 using (note(column("time_s"), column("discharged_kg"))) with table
unset table
set terminal pop
if (first == first) {
  margin = 0.25 * (last - first)
  set xrange [first - margin : last + margin]
} else { set xrange [0:*] }

set xlabel "time, s"
set format x "%g"
set ylabel "discharged mass"
set format y "%.0s %cg"
set y2label "grains"
set y2tics
set yrange [0:*]
set y2range [0:*]
plot ARG1 using "time_s":(1e3 * column("discharged_kg")) with linespoints linewidth 2.5 pointtype 7 pointsize 0.4 linecolor rgb "#0072b2" title "mass", \
     "" using "time_s":"discharged_grains" axes x1y2 with lines linewidth 2 dashtype 2 linecolor rgb "#d55e00" title "grains"
