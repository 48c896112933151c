/*
 * orders.c - in which order should the groups of axes be tested? The experiment of the paper's section 3, timed for every order.
 *
 *     cc -std=c11 -O2 orders.c $(pkg-config --cflags --libs tribox) -o orders && ./orders
 */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <time.h>
#include <tribox.h>

enum { TRIANGLES = 100000, ROUNDS = 25, ORDERS = 6 };

static float stream[9][TRIANGLES];
static uint64_t mask[(TRIANGLES + 63) / 64];

/* Vertices uniform in a cube of side 4 around the unit box. */
static void make_soup(void)
{
    uint32_t state = 1;
    for (int i = 0; i < TRIANGLES; i++)
        for (int s = 0; s < 9; s++) {
            state = state * 1664525 + 1013904223;
            stream[s][i] = (float)(state >> 8) * 0x1p-22f - 2;
        }
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(void)
{
    const tribox_soup soup = {
        {stream[0], stream[1], stream[2]}, {stream[3], stream[4], stream[5]}, {stream[6], stream[7], stream[8]}, TRIANGLES};
    const tribox_box box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
    static const unsigned order[ORDERS] = {123, 132, 213, 231, 312, 321};
    double least[ORDERS] = {0};
    tribox_report report[ORDERS];
    make_soup();

    /* Every round times all orders, so that a slow moment of the machine hits all of them; the least time of each counts. */
    for (int round = 0; round < ROUNDS; round++)
        for (int k = 0; k < ORDERS; k++) {
            const tribox_options options = {.axis_order = order[k]};
            const double start = seconds_now();
            const tribox_status status = tribox_overlap(&soup, &box, &options, mask, &report[k]);
            const double taken = seconds_now() - start;
            if (status != TRIBOX_OK) {
                fprintf(stderr, "tribox: %s\n", tribox_status_text(status));
                return 1;
            }
            if (round == 0 || taken < least[k])
                least[k] = taken;
        }

    printf("kernel %s, %d triangles; 1 box normals, 2 plane, 3 edges\n", tribox_kernel_name(NULL), TRIANGLES);
    printf("order  ns a triangle  overlapping  left to the exact stage\n");
    for (int k = 0; k < ORDERS; k++)
        printf("  %u %14.2f %12zu %24zu\n", order[k], 1e9 * least[k] / TRIANGLES, report[k].overlapping, report[k].undecided);
    return 0;
}
