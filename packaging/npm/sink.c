/* sink.c - the sink of the npm package, which hands bricks on to JavaScript: that cannot be pointed to by itself. */
#include "tribox.h"

__attribute__((import_module("tribox"), import_name("take"))) int tribox_take(void *data, const uint32_t at[3],
                                                                              const uint64_t bits[8]);

/* What tribox_sink.take is to be. */
typedef int tribox_taker(void *data, const uint32_t at[3], const uint64_t bits[8]);
TRIBOX_API tribox_taker *sink_taker(void);

tribox_taker *sink_taker(void) { return tribox_take; }
