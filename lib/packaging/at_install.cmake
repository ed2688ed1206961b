# Functions of lib/packaging/install.cmake that run in `cmake --install`, because only it knows the prefix. In folders that the loader
# searches by default, no file tells programs where the libraries are, as Debian's policy requires. From any other prefix programs start
# without LD_LIBRARY_PATH. Takes SUPERNORMAL_LIBDIR and SUPERNORMAL_INCLUDEDIR, relative to the prefix or absolute, and
# SUPERNORMAL_ARCHITECTURE, Debian's name of it.
cmake_path(ABSOLUTE_PATH SUPERNORMAL_LIBDIR BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}" NORMALIZE OUTPUT_VARIABLE supernormal_full_libdir)
set(supernormal_loader_looks_there OFF)
if(supernormal_full_libdir MATCHES "^(/usr)?/lib(32|64|x32)?(/${SUPERNORMAL_ARCHITECTURE})?/?$")
  set(supernormal_loader_looks_there ON)
endif()

# supernormal_settle_search_path(library): the library was linked with $ORIGIN, to find the core beside itself.
function(supernormal_settle_search_path library)
  set(file "$ENV{DESTDIR}${supernormal_full_libdir}/${library}")
  if(supernormal_loader_looks_there AND EXISTS "${file}")
    file(RPATH_REMOVE FILE "${file}")
  endif()
endfunction()

# supernormal_install_pc(file shared): installs a pkg-config file, with the variables that it uses in front.
function(supernormal_install_pc file shared)
  set(prefix "${CMAKE_INSTALL_PREFIX}")
  if(NOT IS_ABSOLUTE "${SUPERNORMAL_LIBDIR}")  # with the files, the prefix moves
    set(up /prefix)
    cmake_path(RELATIVE_PATH up BASE_DIRECTORY "/prefix/${SUPERNORMAL_LIBDIR}/pkgconfig")
    set(prefix "\${pcfiledir}/${up}")
  endif()
  string(REPLACE " " "\\ " prefix "${prefix}")
  set(text "prefix=${prefix}\n")
  foreach(name libdir includedir)
    string(TOUPPER "SUPERNORMAL_${name}" folder)
    string(REPLACE " " "\\ " folder "${${folder}}")
    if(NOT IS_ABSOLUTE "${folder}")
      string(PREPEND folder "\${prefix}/")
    endif()
    string(APPEND text "${name}=${folder}\n")
  endforeach()
  # A C program names the ODE layer only: its linker finds the core, which that needs, by either option.
  set(search_path "")
  if(shared AND supernormal_loader_looks_there)
    set(search_path "-Wl,-rpath-link,\${libdir}")
  elseif(shared)
    set(search_path "-Wl,-rpath,\${libdir}")
  endif()
  string(APPEND text "search_path=${search_path}\n\n")

  file(READ "${file}" rest)
  cmake_path(GET file FILENAME name)
  string(RANDOM LENGTH 12 unique)  # several installations may run at once
  file(WRITE "${file}.${unique}" "${text}${rest}")
  file(INSTALL DESTINATION "${supernormal_full_libdir}/pkgconfig" TYPE FILE RENAME "${name}" FILES "${file}.${unique}")
  file(REMOVE "${file}.${unique}")
  set(CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_MANIFEST_FILES}" PARENT_SCOPE)
endfunction()
