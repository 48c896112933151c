/* machine.h - on what a figure was measured. Without it a figure says nothing. */
#ifndef BENCH_MACHINE_H
#define BENCH_MACHINE_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct machine {
    char processor[128]; /* as the operating system names it */
    bool is_virtual;     /* a hypervisor shows itself */
    double load;         /* processes that wanted to run in the last minute; negative if unknown */
    const char *compiler, *flags, *commit;
} machine;

machine machine_here(void);

#ifdef __cplusplus
}
#endif

#endif
