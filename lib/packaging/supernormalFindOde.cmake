# Finds ODE: for the build of the ODE layer, and for projects that link the installed one. First the CMake package that ODE's own CMake
# build installs, which knows whether the library is ode, ode_double or ode_single; then pkg-config (Debian). Gives
#   supernormal::ODE              the target to link; it is there if ODE was found
#   SUPERNORMAL_ODE_PRECISION     dSINGLE or dDOUBLE, of the headers
#   SUPERNORMAL_ODE_PROBLEM       what is missing, or empty
set(SUPERNORMAL_ODE_PROBLEM "")
set(supernormal_precisions "")
find_package(ODE QUIET CONFIG NAMES ode ODE)  # its package refuses every version but its own
if(TARGET ODE::ODE AND NOT ODE_VERSION VERSION_LESS 0.16)
  set(supernormal_ode_target ODE::ODE)
else()
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(SUPERNORMAL_ODE QUIET IMPORTED_TARGET ode>=0.16)
  endif()
  if(NOT SUPERNORMAL_ODE_FOUND)
    set(SUPERNORMAL_ODE_PROBLEM "neither CMake (package ode) nor pkg-config finds ode >= 0.16 (Debian: libode-dev)")
    return()
  endif()
  set(supernormal_ode_target PkgConfig::SUPERNORMAL_ODE)
  pkg_get_variable(supernormal_precisions ode precision)
endif()

# An ODE include directory in front of the installed one (the upstream tarball's, say) can declare another dReal than the library
# was built with; every call would then pass garbage. The library asks ODE again at run time, in snInit.
include(CheckSourceCompiles)
get_property(supernormal_language GLOBAL PROPERTY ENABLED_LANGUAGES)
if("CXX" IN_LIST supernormal_language)
  set(supernormal_language CXX)
else()
  set(supernormal_language C)
endif()
if(NOT supernormal_precisions)
  set(supernormal_precisions dDOUBLE dSINGLE)
endif()
set(SUPERNORMAL_ODE_PRECISION "")
set(supernormal_required ${CMAKE_REQUIRED_LIBRARIES})  # of the project that looks for us
set(CMAKE_REQUIRED_LIBRARIES ${supernormal_ode_target})
foreach(precision ${supernormal_precisions})
  check_source_compiles(
    ${supernormal_language}
    "#include <ode/ode.h>
     #ifndef ${precision}
     #error The headers have another precision.
     #endif
     int main(void) { return 0; }"
    SUPERNORMAL_ODE_HEADERS_ARE_${precision})
  if(SUPERNORMAL_ODE_HEADERS_ARE_${precision})
    set(SUPERNORMAL_ODE_PRECISION ${precision})
    break()
  endif()
  unset(SUPERNORMAL_ODE_HEADERS_ARE_${precision} CACHE)  # another ODE may be found next time
endforeach()
set(CMAKE_REQUIRED_LIBRARIES ${supernormal_required})
if(NOT SUPERNORMAL_ODE_PRECISION)
  list(JOIN supernormal_precisions " or " supernormal_precisions)
  set(SUPERNORMAL_ODE_PROBLEM "the library is of ODE with ${supernormal_precisions}, but the <ode/ode.h> that the compiler finds is not, or does not "
      "compile: look for another ODE include directory in CXXFLAGS or CPLUS_INCLUDE_PATH")
  list(JOIN SUPERNORMAL_ODE_PROBLEM "" SUPERNORMAL_ODE_PROBLEM)
endif()
if(NOT TARGET supernormal::ODE)
  add_library(supernormal::ODE INTERFACE IMPORTED)
  set_property(TARGET supernormal::ODE PROPERTY INTERFACE_LINK_LIBRARIES ${supernormal_ode_target})
endif()
