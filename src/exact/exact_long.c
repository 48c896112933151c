/* exact_long.c - pairs of any finite doubles: in double where rounding cannot turn a sign, else in a sum as long as it takes. */
#include "exact.h"

#include "accumulator.h"
#include "kernel.h"

/* A product of differences: those of the first two numbers, the next two and so on. */
enum { TERMS_MAX = 6 };
typedef struct exact_term {
    double difference[ACCUMULATOR_FACTORS][2];
} exact_term;

typedef struct exact_points {
    double at[3][TRIBOX_POINTS];
    int sign_of_n[3];
    bool is_tame; /* every number is */
} exact_points;

/* Neither so small nor so large that products of three differences underflow or overflow. */
static bool is_tame_number(double number)
{
    const double size = fabs(number);
    return size == 0 || (size >= 0x1p-200 && size <= 0x1p200);
}

/*
 * Whether the sum of the terms has the sign that double finds: a term is rounded five times at most, and there are five sums
 * (PROOFS.md 9.3).
 */
static bool is_certain_in_double(const exact_term term[], int terms, int factors, int *sign)
{
    double sum = 0, size = 0;
    for (int k = 0; k < terms; k++) {
        double product = 1;
        for (int f = 0; f < factors; f++)
            product *= term[k].difference[f][0] - term[k].difference[f][1];
        sum += product;
        size += fabs(product);
    }
    *sign = (sum > 0) - (sum < 0);
    return fabs(sum) >= 0x1p-49 * size;
}

/* Every product of one number from each difference, those of the second numbers negative. */
static void add_term(accumulator *sum, const exact_term *term, int factors)
{
    for (int f = 0; f < factors; f++)
        if (term->difference[f][0] == term->difference[f][1])
            return;
    for (int choice = 0; choice < 1 << factors; choice++) {
        double factor[ACCUMULATOR_FACTORS];
        bool is_zero = false;
        for (int f = 0; f < factors; f++) {
            const bool is_second = choice >> f & 1;
            factor[f] = is_second ? -term->difference[f][1] : term->difference[f][0];
            is_zero = is_zero || factor[f] == 0;
        }
        if (!is_zero)
            accumulator_add(sum, factor, factors);
    }
}

static int sign_of_sum(const exact_term term[], int terms, int factors, bool is_tame)
{
    int sign;
    if (is_tame && is_certain_in_double(term, terms, factors, &sign))
        return sign;
    accumulator sum;
    accumulator_clear(&sum);
    for (int k = 0; k < terms; k++)
        add_term(&sum, &term[k], factors);
    return accumulator_sign(&sum);
}

static void set_difference(double difference[2], double from, double less)
{
    difference[0] = from;
    difference[1] = less;
}

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
