# Read by cpack once for each generator. A package that a system's package manager installs goes to /usr, which the installation is to
# know; an archive may be unpacked anywhere.
if(CPACK_GENERATOR MATCHES "^(DEB|RPM)$")
  set(CPACK_SET_DESTDIR ON)
  set(CPACK_INSTALL_PREFIX /usr)
endif()
if(CPACK_GENERATOR STREQUAL "DEB")
  set(CPACK_PRE_BUILD_SCRIPTS ${CPACK_SUPERNORMAL_COMPLETE_DEBIAN})
endif()
