/*
 * consumer.c - somebody else's program, in C11 and in C++17: prints the version that it was compiled for; with an argument, the
 * kernels that it finds.
 */
#include <stdio.h>

#include <tribox.h>

/* Two triangles, of which the second is far from the box. */
static const float x[3][2] = {{0, 9}, {1, 9}, {0, 8}};
static const float y[3][2] = {{0, 9}, {0, 8}, {1, 9}};
static const float z[3][2] = {{0, 9}, {0, 9}, {1, 9}};

static int soup_is_right(const tribox_box *box)
{
    tribox_soup soup;
    uint64_t mask = ~(uint64_t)0;
    tribox_report report;
    soup.count = 2;
    for (int v = 0; v < 3; v++) {
        soup.x[v] = x[v];
        soup.y[v] = y[v];
        soup.z[v] = z[v];
    }
    return tribox_overlap(&soup, box, NULL, &mask, &report) == TRIBOX_OK && mask == 1 && report.overlapping == 1 &&
           tribox_soup_not_finite(&soup, NULL) == 0;
}

static int boxes_are_right(const tribox_box *box)
{
    static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 1};
    float lo[3], hi[3];
    tribox_boxes boxes;
    uint64_t mask = ~(uint64_t)0;
    boxes.count = 1;
    for (int a = 0; a < 3; a++) {
        lo[a] = (float)box->lo[a];
        hi[a] = (float)box->hi[a];
        boxes.lo[a] = &lo[a];
        boxes.hi[a] = &hi[a];
    }
    return tribox_overlap_boxes(triangle, &boxes, NULL, &mask, NULL) == TRIBOX_OK && mask == tribox_mask_words(1);
}

static void print_kernels(void)
{
    for (size_t i = 0; tribox_kernel_list(i); i++)
        printf("%s\n", tribox_kernel_list(i));
}

int main(int count, char **arguments)
{
    (void)arguments;
    const tribox_box box = {{-1, -1, -1}, {1, 1, 1}};
    if (!soup_is_right(&box) || !boxes_are_right(&box)) {
        fprintf(stderr, "wrong answer from kernel %s\n", tribox_kernel_name(NULL));
        return 1;
    }
    if (tribox_overlap(NULL, &box, NULL, NULL, NULL) == TRIBOX_OK) {
        fprintf(stderr, "no error, though there should be: %s\n", tribox_status_text(TRIBOX_BAD_ARGUMENT));
        return 1;
    }
    if (count > 1)
        print_kernels();
    else
        printf("%d.%d.%d\n", TRIBOX_VERSION_MAJOR, TRIBOX_VERSION_MINOR, TRIBOX_VERSION_PATCH);
    return 0;
}
