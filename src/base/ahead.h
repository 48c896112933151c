/* ahead.h - addresses that are read or written soon: they may come into the cache. */
#ifndef TRIBOX_AHEAD_H
#define TRIBOX_AHEAD_H

#if defined(__GNUC__) || defined(__clang__)
#define TRIBOX_AHEAD(at, is_write) __builtin_prefetch(at, is_write)
#else
#define TRIBOX_AHEAD(at, is_write) ((void)(at))
#endif

static inline void tribox_will_read(const void *at) { TRIBOX_AHEAD(at, 0); }
static inline void tribox_will_write(const void *at) { TRIBOX_AHEAD(at, 1); }

#endif
