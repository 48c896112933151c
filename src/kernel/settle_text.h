/* settle_text.h - the texts of the second stage, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#include "axes.h"
#include "kernel/settle/bounds.h"
#include "kernel/settle/doubles.h"
#define CODED_NUMBER double
#define CODED_NUMBERS wide
#define CODED_READ v_read
#include "codes.h"

tribox_code TRIBOX_SYMBOL(code_doubles);
void TRIBOX_SYMBOL(code_doubles)(const void *positions, size_t count, const tribox_coded_box *box, uint8_t *code)
{
    code_positions(positions, count, box, code);
}
