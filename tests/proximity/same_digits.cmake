# cmake -D PROGRAM=digits -P same_digits.cmake: the answers have the same digits whatever the C library and the compiler know of the
# processor. glibc chooses its pow, exp and log by it, and GLIBC_TUNABLES hides what it has.
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY)
foreach(hidden "-AVX2,-FMA" "-AVX512F,-AVX2,-FMA,-FMA4,-AVX" "-SSE4_1,-AVX,-AVX2,-FMA")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env "GLIBC_TUNABLES=glibc.cpu.hwcaps=${hidden}" ${PROGRAM}
    OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
  if(NOT found STREQUAL expected)
    message(SEND_ERROR "${hidden}: ${found} instead of ${expected}")
  endif()
endforeach()
