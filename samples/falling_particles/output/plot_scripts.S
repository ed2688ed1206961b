// The scripts of plots/ as texts that end with a zero. The compiler's -I says where they are.
    .macro script name
    .global plot_\name
plot_\name:
    .incbin "\name\().gp"
    .byte 0
    .endm

    .section .rodata
    script energies
    script state
    script discharge
    script compression
    .section .note.GNU-stack, "", @progbits
