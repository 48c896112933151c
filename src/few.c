/* few.c - the streams of a few pairs, each into a packet of its own. */
#include "few.h"

#include "soup.h"

const tribox_soup *tribox_few_triangles(const tribox_soup *soup, const tribox_kernel *kernel, tribox_few *few)
{
    const float *stream[9];
    for (int a = 0; a < 3; a++)
        for (int v = 0; v < 3; v++)
            stream[3 * a + v] = tribox_soup_axis(soup, a)[v];
    kernel->spread(stream, 9, soup->count, few->number);
    few->soup = tribox_soup_of(&few->number[0][0], TRIBOX_LANES_MAX, soup->count);
    return &few->soup;
}

static const tribox_boxes *few_boxes(const tribox_boxes *boxes, const tribox_kernel *kernel, tribox_few *few)
{
    const float *stream[6];
    for (int a = 0; a < 3; a++) {
        stream[a] = boxes->lo[a];
        stream[3 + a] = boxes->hi[a];
        few->boxes.lo[a] = few->number[a];
        few->boxes.hi[a] = few->number[3 + a];
    }
    kernel->spread(stream, 6, boxes->count, few->number);
    few->boxes.count = boxes->count;
    return &few->boxes;
}

tribox_pairs tribox_few_pairs(const tribox_pairs *p, const tribox_kernel *kernel, tribox_few *few)
{
    tribox_pairs pairs = *p;
    if (p->soup)
        pairs.soup = tribox_few_triangles(p->soup, kernel, few);
    else
        pairs.boxes = few_boxes(p->boxes, kernel, few);
    return pairs;
}
