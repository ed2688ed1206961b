# Finds ODE and its precision for the ODE layer.
find_package(PkgConfig REQUIRED)
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
pkg_check_modules(SUPERNORMAL_ODE IMPORTED_TARGET ode>=0.16)
if(NOT SUPERNORMAL_ODE_FOUND)
  message(FATAL_ERROR "pkg-config does not find ode >= 0.16 (Debian: libode-dev). The core needs no ODE: "
                      "-D SUPERNORMAL_BUILD_ODE_LAYER=OFF builds it alone")
endif()

# An ODE include directory in front of the installed one (the upstream tarball's, say) can declare another dReal than the library
# was built with; every call would then pass garbage. The library asks ODE again at run time, in snInit.
pkg_get_variable(SUPERNORMAL_ODE_PRECISION ode precision)
if(NOT SUPERNORMAL_ODE_PRECISION MATCHES "^d(SINGLE|DOUBLE)$")
  message(FATAL_ERROR "ode.pc: precision is \"${SUPERNORMAL_ODE_PRECISION}\"; it must be dSINGLE or dDOUBLE")
endif()
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES PkgConfig::SUPERNORMAL_ODE)
check_cxx_source_compiles(
  "#include <ode/ode.h>
   #ifndef ${SUPERNORMAL_ODE_PRECISION}
   #error The headers have another precision.
   #endif
   int main() { return 0; }"
  SUPERNORMAL_ODE_HEADERS_ARE_${SUPERNORMAL_ODE_PRECISION})
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT SUPERNORMAL_ODE_HEADERS_ARE_${SUPERNORMAL_ODE_PRECISION})
  message(FATAL_ERROR "libode was built with ${SUPERNORMAL_ODE_PRECISION} (ode.pc), but the <ode/ode.h> that the compiler finds was "
                      "not, or does not compile: look for another ODE include directory in CXXFLAGS or CPLUS_INCLUDE_PATH")
endif()
