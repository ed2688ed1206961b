// The built page of page/, as bytes. SUPERNORMAL_VIEW_PAGE is its path.
    .section .rodata
    .global view_page_html, view_page_html_end
view_page_html:
    .incbin SUPERNORMAL_VIEW_PAGE
view_page_html_end:
    .byte 0
    .section .note.GNU-stack, "", @progbits
