// The texts of lists/, each with a zero at its end. The compiler's -I says where they are.
    .macro list symbol, file
    .global \symbol
\symbol:
    .incbin "\file"
    .byte 0
    .endm

    .section .rodata
    list kSectionsList, "sections.txt"
    list kWallsList, "walls.txt"
    list kPopulationList, "population.txt"
    .section .note.GNU-stack, "", @progbits
