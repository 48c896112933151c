/*
 * thread_stack.h - how much stack a call takes: that of a thread is painted before the call, and what is still painted after it was
 * not touched. After cmocka.h.
 */
#ifndef TRIBOX_TESTS_THREAD_STACK_H
#define TRIBOX_TESTS_THREAD_STACK_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#if !defined(__wasm__)
#include <pthread.h>
#endif

enum { STACK_BYTES = 1 << 20, STACK_PAINT = 0x5a };

static inline void *call_nothing(void *data) { return data; }

#if defined(__wasm__)
/* There are no threads: what lies below this frame is painted, in half of what the linker gave. */
static inline size_t stack_touched(void *(*run)(void *), void *data)
{
    enum { BELOW = STACK_BYTES / 2 };
    volatile unsigned char *const stack = (volatile unsigned char *)((uintptr_t)__builtin_frame_address(0) - BELOW);
    size_t untouched = 0;
    for (size_t i = 0; i < BELOW; i++)
        stack[i] = STACK_PAINT;
    run(data);
    while (untouched < BELOW && stack[untouched] == STACK_PAINT)
        untouched++;
    return BELOW - untouched;
}
#elif defined(_WIN32)
/* Threads take no stack that is made for them. */
static inline size_t stack_touched(void *(*run)(void *), void *data)
{
    run(data);
    return 0;
}
#else
/* The bytes of stack that a thread touches. */
static inline size_t stack_touched(void *(*run)(void *), void *data)
{
    unsigned char *const stack = aligned_alloc(4096, STACK_BYTES);
    pthread_attr_t attributes;
    pthread_t thread;
    size_t untouched = 0;
    assert_non_null(stack);
    memset(stack, STACK_PAINT, STACK_BYTES);
    assert_int_equal(pthread_attr_init(&attributes), 0);
    assert_int_equal(pthread_attr_setstack(&attributes, stack, STACK_BYTES), 0);
    assert_int_equal(pthread_create(&thread, &attributes, run, data), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    pthread_attr_destroy(&attributes);
    while (untouched < STACK_BYTES && stack[untouched] == STACK_PAINT)
        untouched++;
    free(stack);
    return STACK_BYTES - untouched;
}
#endif

/*
 * Whether what is measured counts: instrumented code, and code that is not optimised, takes more, but not where vectors live
 * outside of memory.
 */
static inline bool is_ordinary_build(void)
{
#if defined(__wasm__)
    return true;
#elif !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(_WIN32)
    return false;
#elif defined(__has_feature)
    return !__has_feature(address_sanitizer) && !__has_feature(memory_sanitizer);
#else
    return true;
#endif
}

/* The bytes that the call takes, besides those that any thread does. */
static inline size_t stack_of(void *(*run)(void *), void *data)
{
    const size_t empty = stack_touched(call_nothing, NULL);
    return stack_touched(run, data) - empty;
}

#endif
