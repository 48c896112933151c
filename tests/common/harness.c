#include "harness.h"

arguments args;
const char *names[KERNELS_MAX];
int kernels;

int harness_begin(int argc, char **argv, int (*set_up)(void))
{
    args = arguments_parse(argc, argv);
    kernels = kernels_here(names);
    cmocka_set_test_filter(args.cases);
    return set_up ? set_up() : 0;
}
