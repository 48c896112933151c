/* fill_bodies.h - bodies made of formulas that show what filling does: closed, open, doubled, through each other. */
#ifndef FILL_BODIES_H
#define FILL_BODIES_H

#include <tribox.h>

enum { FILL_TRIANGLES = 20000 };

/* Within x 0 .. 64, y 0 .. 48 and z 0 .. 48. */
typedef struct fill_body {
    float stream[9][FILL_TRIANGLES]; /* x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 */
    size_t count;
} fill_body;

typedef struct fill_kind {
    const char *name;
    void (*make)(fill_body *body);
} fill_kind;

size_t fill_kind_count(void);
const fill_kind *fill_kind_at(size_t n);

tribox_soup fill_body_soup(const fill_body *body);

#endif
