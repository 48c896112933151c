/* crc32.c - remainders of polynomials over two elements; the highest bit is the coefficient of the lowest power. */
#include "crc32.h"

#include "read/little.h"

static const uint32_t divisor = 0xedb88320, one = 0x80000000;

static uint32_t times_x(uint32_t p) { return p >> 1 ^ (p & 1 ? divisor : 0); }

static uint32_t product(uint32_t a, uint32_t b)
{
    uint32_t sum = 0;
    for (; a; a <<= 1, b = times_x(b))
        sum ^= a & one ? b : 0;
    return sum;
}

/* tables->of[n][byte]: what the byte adds to the checksum when n bytes come after it. */
void crc32_make_tables(crc32_tables *tables)
{
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t p = byte;
        for (int n = 0; n < 8; n++) {
            for (int bit = 0; bit < 8; bit++)
                p = times_x(p);
            tables->of[n][byte] = p;
        }
    }
}

uint32_t crc32_add(const crc32_tables *tables, uint32_t crc, const void *bytes, size_t count)
{
    const unsigned char *at = bytes;
    crc = ~crc;
    for (; count >= 8; count -= 8, at += 8) {
        const uint64_t word = little_get64(at) ^ crc;
        crc = 0;
        for (int n = 0; n < 8; n++)
            crc ^= tables->of[7 - n][word >> 8 * n & 0xff];
    }
    for (; count; count--)
        crc = crc >> 8 ^ tables->of[0][(crc ^ *at++) & 0xff];
    return ~crc;
}

/* The first is multiplied by x^(8 count), by repeated squaring of x^8. */
uint32_t crc32_join(uint32_t first, uint32_t second, uint64_t count)
{
    for (uint32_t power = one >> 8; count; count >>= 1, power = product(power, power))
        first = count & 1 ? product(first, power) : first;
    return first ^ second;
}
