/* rounding.h - whether a product is rounded before it meets a sum, as it is written (kernel.h). After: a vocabulary. */

/* A square of 25 bits, less what it is rounded to. */
static bool rounds_products(void)
{
    const volatile float number = 1 + 0x1p-12f;
    const float once = number, again = number;
    const volatile float square = once * once;
    return m_bits(v_is_zero(v_sub(v_mul(v_splat(again), v_splat(again)), v_splat(square)))) == LANES_ALL;
}
