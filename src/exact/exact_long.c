/* exact_long.c - pairs of any finite doubles: in double where rounding cannot turn a sign, else in a sum as long as it takes. */
#include "exact.h"

#include "kernel.h"
#include "terms.h"

typedef struct exact_points {
    double at[3][TRIBOX_POINTS];
    int sign_of_n[3];
    bool is_tame; /* every number is */
} exact_points;

/* f_ja as a difference, and turned: u_ja - u_(j+1)a. */
static void set_edge(double difference[2], const exact_points *p, int j, int a)
{
    set_difference(difference, p->at[a][(j + 1) % 3], p->at[a][j]);
}

static void set_turned_edge(double difference[2], const exact_points *p, int j, int a)
{
    set_difference(difference, p->at[a][j], p->at[a][(j + 1) % 3]);
}

/* n_i as two terms: f_0a f_1b - f_0b f_1a. */
static void set_normal(exact_term term[2], const exact_points *p, int i)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    set_edge(term[0].difference[0], p, 0, a);
    set_edge(term[0].difference[1], p, 1, b);
    set_turned_edge(term[1].difference[0], p, 0, b);
    set_edge(term[1].difference[1], p, 1, a);
}

static int sign_of_length(const exact_points *p, int j, int a)
{
    const double from = p->at[a][j], to = p->at[a][(j + 1) % 3];
    return (to > from) - (to < from);
}

static int sign_of_normal(const exact_points *p, int i) { return p->sign_of_n[i]; }

static int sign_of_side(const exact_points *p, int i, int j, int k, const int X[2])
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    exact_term term[2];
    set_edge(term[0].difference[0], p, j, b);
    set_difference(term[0].difference[1], p->at[a][k], p->at[a][X[0]]);
    set_turned_edge(term[1].difference[0], p, j, a);
    set_difference(term[1].difference[1], p->at[b][k], p->at[b][X[1]]);
    return sign_of_sum(term, 2, 2, p->is_tame);
}

static int sign_of_height(const exact_points *p, const int X[3])
{
    exact_term term[TERMS_MAX];
    for (int i = 0; i < 3; i++) {
        set_normal(&term[2 * i], p, i);
        for (int k = 0; k < 2; k++)
            set_difference(term[2 * i + k].difference[2], p->at[i][0], p->at[i][X[i]]);
    }
    return sign_of_sum(term, TERMS_MAX, 3, p->is_tame);
}

#include "sides.h"

bool tribox_exact_long(const tribox_pair *pair, unsigned axes)
{
    exact_points p;
    p.is_tame = true;
    for (int a = 0; a < 3; a++) {
        const double number[TRIBOX_POINTS] = {pair->u[0][a], pair->u[1][a], pair->u[2][a], pair->lo[a], pair->hi[a]};
        memcpy(p.at[a], number, sizeof number);
        for (int k = 0; k < TRIBOX_POINTS; k++)
            p.is_tame = p.is_tame && is_tame_number(number[k]);
    }
    for (int i = 0; i < 3; i++) {
        exact_term term[2];
        set_normal(term, &p, i);
        p.sign_of_n[i] = sign_of_sum(term, 2, 2, p.is_tame);
    }
    return are_sides_touching(&p, axes);
}
