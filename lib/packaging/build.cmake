# How everything of this repository is compiled: options, warnings, precompiled headers, unity builds. The library includes this file, and
# so does each product that is built by itself (samples/common/product.cmake).
include_guard(GLOBAL)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

option(SUPERNORMAL_REQUIRE_OPTIONAL "Fail where something would be left out because a package is missing" OFF)
option(SUPERNORMAL_WERROR "Treat warnings as errors" OFF)
# A whole build takes a third of the time with both, and its answers have the same digits.
option(SUPERNORMAL_UNITE "Compile the files of a folder together: a whole build is faster, but a change compiles its neighbours again" ${PROJECT_IS_TOP_LEVEL})
option(SUPERNORMAL_PRECOMPILE "Precompile the headers of Eigen and doctest: builds faster, but hides missing includes" ${PROJECT_IS_TOP_LEVEL})

# Everything of ours is compiled with these; nobody who links us inherits them. GCC 12 finds overlapping copies in
# "text" + std::string where there are none (GCC bug 105651).
add_library(supernormal_warnings INTERFACE)
target_compile_options(
  supernormal_warnings
  INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow $<$<BOOL:${SUPERNORMAL_WERROR}>:-Werror>
            "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow>"
            # GCC collects garbage less often: a file takes a seventh less time, and up to 1.2 GB.
            $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${SUPERNORMAL_UNITE}>>:--param=ggc-min-heapsize=1000000>)

# supernormal_precompile(target owner [headers...]): parsing Eigen is half of the time that a file takes. The owner, which comes first,
# compiles the headers; targets with the same options share them.
function(supernormal_precompile target owner)
  if(SUPERNORMAL_PRECOMPILE AND target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${ARGN} <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <memory> <span> <string> <vector>)
  elseif(SUPERNORMAL_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# supernormal_unite(target [BY_FOLDER] [APART sources...]): compiles whole folders together, up to 20 files at once, and a larger folder in
# equal shares: the time goes to headers and templates, which they share. They may then not give two things one name, even where the names
# are local to a file, nor two functions that take the same numbers. BY_FOLDER is for what has to be fast: each folder by itself. In larger
# units the compiler inlines less, and contacts with meshes take 3 % more instructions.
function(supernormal_unite target)
  if(NOT SUPERNORMAL_UNITE)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "BY_FOLDER" "" "APART")
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(REMOVE_ITEM sources ${arg_APART} "")
  set(folders)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "_${folder}" folder)
    list(APPEND folders ${folder})
    list(APPEND of${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  list(SORT folders)
  set(group 0)
  set(filled 0)
  foreach(folder IN LISTS folders)
    list(LENGTH of${folder} count)
    math(EXPR filled "${filled} + ${count}")
    if(filled GREATER 20 OR (arg_BY_FOLDER AND filled GREATER count))
      math(EXPR group "${group} + 1")
      set(filled ${count})
    endif()
    math(EXPR shares "(${count} + 19) / 20")
    set(number 0)
    foreach(source IN LISTS of${folder})
      math(EXPR share "${group} + ${number} * ${shares} / ${count}")
      math(EXPR number "${number} + 1")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${share}")
    endforeach()
    set(group ${share})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# For the target of a program's main file alone. Reading a command line needs no speed, and CLI11 takes half the time to compile.
function(supernormal_parse_command_line target)
  find_package(CLI11 2.1 REQUIRED)
  target_link_libraries(${target} PRIVATE CLI11::CLI11)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# supernormal_leave_out(what reason)
function(supernormal_leave_out what reason)
  if(SUPERNORMAL_REQUIRE_OPTIONAL)
    message(FATAL_ERROR "${what} would be left out, but SUPERNORMAL_REQUIRE_OPTIONAL is ON: ${reason}")
  endif()
  message(STATUS "${what} is left out: ${reason}")
endfunction()
