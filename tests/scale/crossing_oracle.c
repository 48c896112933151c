/* crossing_oracle.c - crossings of rays along x by integers. */
#include "crossing_oracle.h"

#include <math.h>
#include <string.h>

#include <gmp.h>

#include "common/pair_f64.h"

static mpz_t at[3], p[3][3], turn[3], area, sum, product;
static bool is_ready;

static void get_ready(void)
{
    for (int k = 0; !is_ready && k < 3; k++) {
        mpz_init(at[k]);
        mpz_init(turn[k]);
        for (int a = 0; a < 3; a++)
            mpz_init(p[k][a]);
    }
    if (!is_ready)
        mpz_inits(area, sum, product, NULL);
    is_ready = true;
}

/*
 * The point is moved by e^3, e and e^2. Sides and heights are polynomials in e, of coefficients that are multiples of 2^(-3 bits)
 * and below 2^(3 bits + 3): where e is 2^(-6 bits - 10), the first of them has its way. The unit is e^3 2^-bits.
 */
static unsigned long moved_by(const crossing_case *c, int power) { return (unsigned long)(power * (6 * c->bits + 10)); }

static void set_number(mpz_t to, const crossing_case *c, double number)
{
    int exponent;
    const double fraction = frexp(number, &exponent);
    mpz_set_d(to, ldexp(fraction, 53));
    const long shift = (long)exponent - 53 + c->bits + (long)moved_by(c, 3);
    mpz_mul_2exp(to, to, (unsigned long)shift);
}

static void set_point(const crossing_case *c, int a, double number)
{
    static const int power[3] = {3, 1, 2};
    set_number(at[a], c, number);
    mpz_set_ui(product, 1);
    mpz_mul_2exp(product, product, (unsigned long)c->bits + moved_by(c, 3 - power[a]));
    mpz_add(at[a], at[a], product);
}

/* to = (b - a) x (point - a), seen along x. */
static void set_turn(mpz_t to, mpz_t a[3], mpz_t b[3])
{
    mpz_sub(sum, b[1], a[1]);
    mpz_sub(product, at[2], a[2]);
    mpz_mul(to, sum, product);
    mpz_sub(sum, b[2], a[2]);
    mpz_sub(product, at[1], a[1]);
    mpz_submul(to, sum, product);
}

static bool is_beside(const double u[3][3], double y, double z)
{
    const double point[3] = {0, y, z};
    for (int a = 1; a < 3; a++)
        if ((u[0][a] < point[a] && u[1][a] < point[a] && u[2][a] < point[a]) ||
            (u[0][a] > point[a] && u[1][a] > point[a] && u[2][a] > point[a]))
            return true;
    return false;
}

/* Where the ray crosses, if it does: at sum / area, the mean of the vertices, each by what the edge across from it leaves. */
static bool crosses(const crossing_case *c, const double u[3][3])
{
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            set_number(p[v][a], c, u[v][a]);
    for (int v = 0; v < 3; v++)
        set_turn(turn[v], p[(v + 1) % 3], p[(v + 2) % 3]);
    if (mpz_sgn(turn[0]) == 0 || mpz_sgn(turn[0]) != mpz_sgn(turn[1]) || mpz_sgn(turn[1]) != mpz_sgn(turn[2]))
        return false;
    mpz_set_ui(sum, 0);
    mpz_set_ui(area, 0);
    for (int v = 0; v < 3; v++) {
        mpz_add(area, area, turn[v]);
        mpz_addmul(sum, turn[v], p[v][0]);
    }
    return true;
}

static bool is_past_crossing(void)
{
    mpz_mul(product, at[0], area);
    return mpz_cmp(product, sum) * mpz_sgn(area) > 0;
}

void crossing_oracle(const crossing_case *c, bool *is_inside, bool *is_odd)
{
    get_ready();
    memset(is_inside, 0, (size_t)c->size[0] * c->size[1] * c->size[2] * sizeof *is_inside);
    for (uint32_t row = 0; row < c->size[1] * c->size[2]; row++) {
        const double y = c->middle[1][row % c->size[1]], z = c->middle[2][row / c->size[1]];
        is_odd[row] = false;
        set_point(c, 1, y);
        set_point(c, 2, z);
        for (int t = 0; t < c->count; t++) {
            if (!are_finite(&c->u[t][0][0], 9) || is_beside(c->u[t], y, z) || !crosses(c, c->u[t]))
                continue;
            is_odd[row] = !is_odd[row];
            for (uint32_t i = 0; i < c->size[0]; i++) {
                set_point(c, 0, c->middle[0][i]);
                is_inside[row * c->size[0] + i] ^= is_past_crossing();
            }
        }
    }
}
