# The core (shapes, gap function, solvers, contact points) needs Eigen only. Every include of a core file must be on the list
# below; by induction nothing that the core includes reaches ODE or lib/ode. <pthread.h> is for kept_by_key.hpp: threads of MinGW.
#   cmake -D SOURCE_DIR=<root> -P core_includes_no_ode.cmake
set(core "base|shapes|shapes/lanes|proximity|proximity/gap|proximity/bounds|proximity/local|proximity/search|proximity/lanes|proximity/derivatives|raycast|impact|contact|contact/ahead|contact/manifold|contact/mesh")
set(allowed
    "^#include (<[a-z_]+>|<immintrin\\.h>|<cxxabi\\.h>|<pthread\\.h>|<Eigen/.+>|\"(supernormal/)?(${core})/[a-z0-9_]+\\.hpp\"|\"supernormal/export\\.h\")")

set(include ${SOURCE_DIR}/include/supernormal)
file(GLOB_RECURSE files ${SOURCE_DIR}/lib/base/*.?pp ${SOURCE_DIR}/lib/shapes/*.?pp ${SOURCE_DIR}/lib/proximity/*.?pp ${SOURCE_DIR}/lib/raycast/*.?pp ${SOURCE_DIR}/lib/impact/*.?pp ${SOURCE_DIR}/lib/contact/*.?pp
     ${include}/shapes/* ${include}/proximity/* ${include}/raycast/* ${include}/impact/* ${include}/contact/* ${include}/supernormal.hpp)
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
