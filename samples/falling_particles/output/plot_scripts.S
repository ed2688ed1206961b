// The scripts of plots/ as texts that end with a zero. The compiler's -I says where they are.
    .macro script symbol, file
    .global \symbol
\symbol:
    .incbin "\file"
    .byte 0
    .endm

    .section .rodata
    script kEnergiesScript, "energies.gp"
    script kStateScript, "state.gp"
    script kDischargeScript, "discharge.gp"
    script kCompressionScript, "compression.gp"
    script kMeasurementScript, "measurement.gp"
    .section .note.GNU-stack, "", @progbits
