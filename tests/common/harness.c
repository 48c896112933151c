#include "harness.h"

arguments args;
const char *names[KERNELS_MAX];
int kernels;

int harness_knows_case(const struct CMUnitTest *cases, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!args.named_case || !strcmp(cases[k].name, args.named_case))
            return 1;
    fprintf(stderr, "no case is called '%s'\n", args.named_case);
    return 0;
}

int harness_begin(int argc, char **argv, int (*set_up)(void))
{
    args = arguments_parse(argc, argv);
    kernels = kernels_here(names);
    cmocka_set_test_filter(args.named_case);
    return set_up ? set_up() : 0;
}
