# A measurement's table over time, some columns of one unit:
#   gnuplot -c measurement.gp stress.csv "stress, Pa" pressure_Pa deviator_Pa > stress.svg
set terminal svg size 900,480 font "sans-serif,15" background "white" noenhanced
set encoding utf8
set datafile separator ","
set grid linecolor rgb "#d0d0d0"
set border 3
set tics nomirror
set key above right samplen 2 maxrows 1
set lmargin 12
set rmargin 3
set xlabel "time, s"
set ylabel ARG2
set format x "%g"
array colours[3] = ["#0072b2", "#d55e00", "#009e73"]
columns = (ARGC > 2) + (ARGC > 3) + (ARGC > 4)
array names[3] = [ARG3, ARG4, ARG5]
plot for [i=1:columns] ARG1 using "time_s":(column(names[i])) with points pointtype 7 pointsize 0.4 linecolor rgb colours[i] title names[i]
