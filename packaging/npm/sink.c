/* sink.c - the sinks of the npm package, which hand bricks on to JavaScript: that cannot be pointed to by itself. */
#include <stddef.h>

#include "tribox.h"

/* What a sink of bricks and one of their lists take. */
typedef int tribox_taker(void *data, const uint32_t at[3], const uint64_t bits[8]);
typedef int tribox_lists_taker(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513],
                               const uint32_t *triangles);

__attribute__((import_module("tribox"), import_name("take"))) tribox_lists_taker tribox_take;
TRIBOX_API tribox_taker *sink_taker(void);
TRIBOX_API tribox_lists_taker *lists_taker(void);

static int take(void *data, const uint32_t at[3], const uint64_t bits[8]) { return tribox_take(data, at, bits, NULL, NULL); }

tribox_taker *sink_taker(void) { return take; }

tribox_lists_taker *lists_taker(void) { return tribox_take; }
