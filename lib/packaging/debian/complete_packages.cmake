# Run by cpack before it makes the packages: adds what Debian's policy asks for to the staged files, and computes the symbols files.
# If a library exports a symbol that is not in <package>.symbols, cpack fails and prints the difference.
set(date $ENV{SOURCE_DATE_EPOCH})
if(date STREQUAL "")
  string(TIMESTAMP date "%s" UTC)
endif()
set(ENV{SOURCE_DATE_EPOCH} ${date})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)

# add_documents(package root): the copyright and the changelog of a package.
function(add_documents package root)
  set(folder ${root}/${CPACK_SUPERNORMAL_DOC_DIR}/${package})
  file(MAKE_DIRECTORY ${folder})
  file(COPY_FILE ${CPACK_RESOURCE_FILE_LICENSE} ${folder}/copyright)
  file(REMOVE_RECURSE ${root}/${CPACK_SUPERNORMAL_DOC_DIR}/${CPACK_PACKAGE_NAME})
  file(WRITE ${folder}/changelog "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Version ${CPACK_PACKAGE_VERSION}.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}
")
  execute_process(COMMAND gzip -9n ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# write_symbols(package root): dpkg-gensymbols misses a symbol only after the version that introduced it, so it gets a later version.
function(write_symbols package root)
  file(GLOB libraries ${root}/${CPACK_SUPERNORMAL_LIB_DIR}/lib*.so.${CPACK_PACKAGE_VERSION})
  set(control ${CPACK_SUPERNORMAL_CONTROL_DIR}/${package})
  file(MAKE_DIRECTORY ${control})
  execute_process(
    COMMAND dpkg-gensymbols -p${package} -v${CPACK_PACKAGE_VERSION}+0 -I${CPACK_SUPERNORMAL_SYMBOLS_DIR}/${package}.symbols -e${libraries}
            -O${control}/symbols -c4
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX})
  add_documents(${package} ${root})
  if(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA)
    write_symbols(${package} ${root})
  endif()
endforeach()
