"""What margin.h says of bounds.h (PROOFS.md 4.2 and 4.3) as polynomials without a negative coefficient.

The sorted extents F are written g1, g1 + g2, g1 + g2 + g3 with gaps g >= 0, in every order of the axes. h is the longest side of
the box, so m_a <= F_a + h. A difference of which no coefficient is negative is not negative itself. Factors that are a little
less leave a negative one.
Usage: python3 margins.py
"""
import sys
from fractions import Fraction
from itertools import permutations


def total(*terms):
    """The sum of polynomials, each times a factor. A polynomial has a coefficient for each product of letters."""
    result = {}
    for factor, polynomial in terms:
        for letters, coefficient in polynomial.items():
            result[letters] = result.get(letters, 0) + factor * coefficient
    return result


def product(*polynomials):
    result = {(): Fraction(1)}
    for polynomial in polynomials:
        before, result = result, {}
        for p, x in before.items():
            for q, y in polynomial.items():
                letters = tuple(sorted(p + q))
                result[letters] = result.get(letters, 0) + x * y
    return result


def least(edges, edges_h, plane, plane_h):
    """The least coefficient of the margins with these factors, in units of u, less the bounds with K = 16 and 24."""
    gaps = [{(name,): Fraction(1)} for name in ("g1", "g2", "g3")]
    h = {("h",): Fraction(1)}
    coefficients = []
    for order in permutations(range(3)):
        F = [total(*((1, gap) for gap in gaps[: order[a] + 1])) for a in range(3)]
        m = [total((1, F[a]), (1, h)) for a in range(3)]
        s = total(*((1, F[a]) for a in range(3)))
        for i in range(3):
            a, b = (i + 1) % 3, (i + 2) % 3
            B = total((1, product(F[a], m[b])), (1, product(F[b], m[a])))
            coefficients += total((edges, product(s, s)), (edges_h, product(s, h)), (-32, B)).values()
        S = total(*((1, product(F[(i + 1) % 3], F[(i + 2) % 3], m[i])) for i in range(3)))
        coefficients += total((plane, product(s, s, s)), (plane_h, product(s, s, h)), (-48, S)).values()
    return min(coefficients)


factors = (Fraction(16), Fraction(32), Fraction(16, 3), Fraction(16))
failures = []
if least(*factors) < 0:
    failures.append(f"the factors {', '.join(map(str, factors))} leave {least(*factors)}")
for k in range(4):
    smaller = [factor - Fraction(1, 100) if j == k else factor for j, factor in enumerate(factors)]
    if least(*smaller) >= 0:
        failures.append(f"{smaller[k]} would do for {factors[k]}")
print("\n".join(failures) or "16 s s + 32 s h and 16/3 s s s + 16 s s h are enough, and none of the four factors can be less")
sys.exit(bool(failures))
