#include "contact.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

float nearest_float(double number)
{
    if (fabs(number) < (double)FLT_MAX)
        return (float)number;
    return number < 0 ? -FLT_MAX : FLT_MAX;
}

float nudged(random_source *r, float number, int ulps)
{
    const int steps = random_int_between(r, -ulps, ulps);
    for (int k = 0; k < (steps < 0 ? -steps : steps); k++)
        number = nextafterf(number, steps < 0 ? -FLT_MAX : FLT_MAX);
    return number;
}

contact_part any_contact_part(random_source *r) { return (contact_part)random_int(r, CONTACT_PARTS); }

/* A component of a direction: of few whole numbers, or any in [-1, 1]. */
static double component(random_source *r, bool is_whole)
{
    return is_whole ? random_int_between(r, -2, 2) : random_double(r, -1, 1);
}

/* Two zeros make a contact with a face, one zero with an edge, none with a corner. */
void draw_outward(random_source *r, contact_style style, double m[3])
{
    do {
        for (int a = 0; a < 3; a++)
            m[a] = random_int(r, 3) ? component(r, style.step > 0) : 0;
    } while (m[0] == 0 && m[1] == 0 && m[2] == 0);
}

/* A point of the box that is farthest along m. */
static void draw_point_of_contact(random_source *r, const tribox_box *box, double step, const double m[3], double p[3])
{
    for (int a = 0; a < 3; a++) {
        const double lo = box->lo[a], hi = box->hi[a];
        if (m[a] != 0)
            p[a] = m[a] > 0 ? hi : lo;
        else
            p[a] = step > 0 ? lo + step * random_int_between(r, 0, (int)((hi - lo) / step)) : random_double(r, lo, hi);
    }
}

/* A direction perpendicular to m. */
static void draw_tangent(random_source *r, bool is_whole, double unit, const double m[3], double t[3])
{
    double q[3];
    for (int a = 0; a < 3; a++)
        q[a] = component(r, is_whole);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        t[a] = unit * (m[b] * q[c] - m[c] * q[b]);
    }
}

/* How far vertices that do not touch lie above the plane of contact: often not at all. */
static double draw_lift(random_source *r, bool is_whole, double unit)
{
    return unit * (is_whole ? random_int_between(r, 0, 2) : random_int(r, 2) * random_double(r, 0, 1));
}

static double draw_factor(random_source *r, bool is_whole)
{
    return is_whole ? random_int_between(r, 1, 2) : random_double(r, 0.1, 2);
}

void draw_contact_along(random_source *r, const tribox_box *box, contact_style style, contact_part part, const double m[3],
                        double u[3][3])
{
    const bool is_whole = style.step > 0;
    const double unit = is_whole ? style.step : style.size;
    double p[3], t[2][3];
    draw_point_of_contact(r, box, style.step, m, p);
    draw_tangent(r, is_whole, unit, m, t[0]);
    draw_tangent(r, is_whole, unit, m, t[1]);
    const double k = draw_factor(r, is_whole), l = draw_factor(r, is_whole);
    const double lift[2] = {draw_lift(r, is_whole, unit), draw_lift(r, is_whole, unit)};
    const int turn = random_int(r, 3);
    for (int a = 0; a < 3; a++) {
        double v[3] = {p[a], p[a], p[a]};
        if (part == CONTACT_VERTEX) {
            v[1] += t[0][a] + lift[0] * m[a];
            v[2] += t[1][a] + lift[1] * m[a];
        } else if (part == CONTACT_EDGE) {
            v[0] += t[0][a];
            v[1] -= k * t[0][a];
            v[2] += t[1][a] + lift[0] * m[a];
        } else {
            v[0] += t[0][a];
            v[1] += t[1][a];
            v[2] -= k * t[0][a] + l * t[1][a];
        }
        for (int j = 0; j < 3; j++)
            u[(j + turn) % 3][a] = v[j];
    }
}

void draw_contact_f64(random_source *r, const tribox_box *box, contact_style style, contact_part part, double u[3][3])
{
    double m[3];
    draw_outward(r, style, m);
    draw_contact_along(r, box, style, part, m, u);
}

void draw_contact(random_source *r, const tribox_box *box, contact_style style, contact_part part, float u[3][3])
{
    double wide[3][3];
    draw_contact_f64(r, box, style, part, wide);
    for (int k = 0; k < 9; k++)
        u[k / 3][k % 3] = nearest_float(wide[k / 3][k % 3]);
}
