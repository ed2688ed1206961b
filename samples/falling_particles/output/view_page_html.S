// The built page of page/, as bytes. SUPERNORMAL_VIEW_PAGE is its path.
    .section .rodata
    .global kViewPageHtml, kViewPageHtmlEnd
kViewPageHtml:
    .incbin SUPERNORMAL_VIEW_PAGE
kViewPageHtmlEnd:
    .byte 0
    .section .note.GNU-stack, "", @progbits
