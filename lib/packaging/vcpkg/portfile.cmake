# Of an overlay port: `vcpkg install supernormal --overlay-ports=lib/packaging/vcpkg` builds the sources that this file stands in.
# GCC, Clang or, for MSVC, ClangCL (a triplet with VCPKG_PLATFORM_TOOLSET ClangCL).
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES ode SUPERNORMAL_BUILD_ODE_LAYER)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS ${features} -DSUPERNORMAL_BUILD_PYTHON=OFF -DSUPERNORMAL_BUILD_DOCUMENTATION=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/supernormal)
vcpkg_fixup_pkgconfig()
vcpkg_copy_pdbs()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
