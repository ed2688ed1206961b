# The core (shapes, gap function, solvers, contact points) needs Eigen only. Every include of a core file must be on the list below; by induction nothing
# that the core includes reaches ODE or lib/ode.
#   cmake -D SOURCE_DIR=<root> -P core_includes_no_ode.cmake
set(allowed "^#include (<[a-z_]+>|<Eigen/.+>|\"(supernormal/)?(shapes|solvers|contact|contact/manifold)/[a-z0-9_]+\\.hpp\"|\"supernormal/export\\.h\"|\"supernormal/contact_(curvature|manifold)\\.hpp\"|\"[a-z0-9_]+\\.hpp\")")

set(include ${SOURCE_DIR}/include/supernormal)
file(GLOB files ${SOURCE_DIR}/lib/shapes/* ${SOURCE_DIR}/lib/solvers/* ${SOURCE_DIR}/lib/contact/*.?pp ${SOURCE_DIR}/lib/contact/manifold/*.?pp ${include}/shapes/* ${include}/solvers/*
     ${include}/supernormal.hpp ${include}/contact_manifold.hpp ${include}/contact_curvature.hpp)
list(LENGTH files count)
if(count LESS 20)
  message(FATAL_ERROR "only ${count} core files under ${SOURCE_DIR}: has the layout changed?")
endif()

set(refused "")
foreach(file ${files})
  file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line ${lines})
    if(NOT line MATCHES "${allowed}")
      string(APPEND refused "\n  ${file}: ${line}")
    endif()
  endforeach()
endforeach()
if(refused)
  message(FATAL_ERROR "the core may include the standard library, Eigen and itself only:${refused}")
endif()
message(STATUS "${count} core files include no ODE")
