# The first lines of the CMake project of a product, a folder of samples/:
#   project(supernormal_NAME LANGUAGES C CXX)
#   include(../common/product.cmake)
# In the tree of the library it takes the library of this build. By itself it takes an installed one:
#   cmake -S samples/NAME -B build/NAME -D CMAKE_PREFIX_PATH=<prefix> && cmake --build build/NAME && ctest --test-dir build/NAME
# A product that needs the core alone sets `product_components` to `core` before. Its tests are in tests/NAME, where it says
# supernormal_add_tests_of_product(NAME) at its end.
get_filename_component(SUPERNORMAL_TREE ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
include(${SUPERNORMAL_TREE}/lib/packaging/build.cmake)

if(NOT TARGET supernormal::core)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release (-O3), Debug, RelWithDebInfo or MinSizeRel" FORCE)
  endif()
  option(SUPERNORMAL_BUILD_TESTS "Build the tests of this product (doctest)" ON)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  find_package(supernormal REQUIRED COMPONENTS ${product_components})
  enable_testing()
endif()
find_package(PkgConfig REQUIRED)

if(SUPERNORMAL_BUILD_TESTS AND NOT TARGET tests_main)
  add_subdirectory(${SUPERNORMAL_TREE}/tests/support ${CMAKE_BINARY_DIR}/tests/support)
endif()
if(NOT TARGET samples_common)
  add_subdirectory(${SUPERNORMAL_TREE}/samples/common ${CMAKE_BINARY_DIR}/samples/common)
endif()

# Every program of this folder reports output that stdout did not accept, also a program that is added later.
function(supernormal_check_stdout folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE)
      target_link_libraries(${target} PRIVATE stdout_check)
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(inner IN LISTS folders)
    supernormal_check_stdout(${inner})
  endforeach()
endfunction()

# supernormal_add_tests_of_product(name): the last line of a product.
function(supernormal_add_tests_of_product name)
  supernormal_check_stdout(${CMAKE_CURRENT_SOURCE_DIR})
  if(SUPERNORMAL_BUILD_TESTS AND EXISTS ${SUPERNORMAL_TREE}/tests/${name}/CMakeLists.txt)
    add_subdirectory(${SUPERNORMAL_TREE}/tests/${name} ${CMAKE_BINARY_DIR}/tests/${name})
  endif()
endfunction()
