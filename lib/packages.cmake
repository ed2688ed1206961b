# `cpack -G DEB` in the build folder makes two Debian packages of what lib/install.cmake installs: the library, and the files that
# programs are built with. A static library is all in the second.
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

set(CPACK_PACKAGE_NAME supernormal)
set(CPACK_PACKAGE_VENDOR Supernormal)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Supernormal authors <supernormal@example.org>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENTS_ALL supernormal_development)

# The summary precedes this text in a package's description.
set(description
    "Ellipsoids, superellipsoids, superovoids, any of them with rounded edges, and
bodies of your own, as one geometry class, exact to the tolerance you ask for.")

set(CPACK_COMPONENT_SUPERNORMAL_DEVELOPMENT_DESCRIPTION "${description}
This package holds the headers, the CMake package and the pkg-config files.")
set(CPACK_DEBIAN_SUPERNORMAL_DEVELOPMENT_PACKAGE_NAME libsupernormal-dev)
set(CPACK_DEBIAN_SUPERNORMAL_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_SUPERNORMAL_DEVELOPMENT_PACKAGE_DEPENDS "libode-dev (>= 2:0.16), libeigen3-dev (>= 3.4)")

if(BUILD_SHARED_LIBS)
  list(PREPEND CPACK_COMPONENTS_ALL supernormal_runtime)
  set(CPACK_COMPONENT_SUPERNORMAL_DEVELOPMENT_DEPENDS supernormal_runtime)
  set(CPACK_COMPONENT_SUPERNORMAL_RUNTIME_DESCRIPTION "${description}
This package holds the shared library.")
  set(CPACK_DEBIAN_SUPERNORMAL_RUNTIME_PACKAGE_NAME libsupernormal${soversion})
  set(CPACK_DEBIAN_SUPERNORMAL_RUNTIME_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_SUPERNORMAL_RUNTIME_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
endif()
include(CPack)
