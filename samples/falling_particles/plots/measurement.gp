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
# "deviator", of the column deviator_Pa: the axis has the unit.
spaced(name) = strstrt(name, "_") > 0 ? name[1:strstrt(name, "_") - 1]." ".spaced(name[strstrt(name, "_") + 1:*]) : name
unit = strstrt(ARG2, ", ") > 0 ? "_".ARG2[strstrt(ARG2, ", ") + 2:*] : ""
per = strstrt(unit, "/")
unit = per > 0 ? unit[1:per - 1]."_per_".unit[per + 1:*] : unit
has_unit(name) = strlen(unit) > 0 && strlen(name) > strlen(unit) && name[strlen(name) - strlen(unit) + 1:*] eq unit
title_of(name) = spaced(has_unit(name) ? name[1:strlen(name) - strlen(unit)] : name)
plot for [i=1:columns] ARG1 using "time_s":(column(names[i])) with points pointtype 7 pointsize 0.4 linecolor rgb colours[i] title title_of(names[i])
