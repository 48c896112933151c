/* mman.h - where no page can be protected: new memory, at the end of all that there is. */
#ifndef TRIBOX_TESTS_MMAN_H
#define TRIBOX_TESTS_MMAN_H

#include <stddef.h>
#include <stdint.h>

enum { PROT_NONE = 0, PROT_READ = 1, PROT_WRITE = 2, MAP_PRIVATE = 2, MAP_ANONYMOUS = 32 };
#define MAP_FAILED ((void *)-1)

static inline void *mmap(void *address, size_t bytes, int protection, int flags, int file, int64_t offset)
{
    enum { PAGE = 65536 };
    (void)address, (void)protection, (void)flags, (void)file, (void)offset;
    const size_t pages = __builtin_wasm_memory_grow(0, (bytes + PAGE - 1) / PAGE);
    return pages == SIZE_MAX ? MAP_FAILED : (void *)(uintptr_t)(pages * PAGE);
}

static inline int mprotect(void *address, size_t bytes, int protection)
{
    (void)address, (void)bytes, (void)protection;
    return 0;
}

static inline int munmap(void *address, size_t bytes) { return mprotect(address, bytes, PROT_NONE); }

#endif
