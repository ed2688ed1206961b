"""Prints the coefficients of powers.hpp: near-minimax polynomials, by Chebyshev interpolation in 60 digits (mpmath)."""

import mpmath
from mpmath import mpf

mpmath.mp.dps = 60
SAMPLES = 4000


def show(name, function, low, high, count):
    """Prints `count` coefficients, lowest first, and the largest relative error of the polynomial with rounded coefficients."""
    polynomial = [mpf(float(c)) for c in mpmath.chebyfit(function, [low, high], count)]
    error = max(
        abs(mpmath.polyval(polynomial, x) / function(x) - 1)
        for x in (low + (high - low) * mpf(k) / SAMPLES for k in range(SAMPLES + 1))
    )
    print(f"{name}: relative error {float(error * 2**53):.2f} * 2^-53")
    print("    " + ", ".join(float(c).hex() for c in reversed(polynomial)))


# 2^r for |r| <= 1/2, with room for the rounding of r.
show("kExp2", lambda r: mpf(2) ** r, mpf(-0.5) - mpf(2) ** -40, mpf(0.5) + mpf(2) ** -40, 12)

# log2(m) = f (c + z q(z)), where f = (m - 1)/(m + 1), z = f^2 and c = 2/ln 2, for m between the roots of 1/2 and 2.
c = 2 / mpmath.ln(2)
print("kLog2Slope:", float(c).hex(), "and the rest", float(c - mpf(float(c))).hex())
largest = ((mpmath.sqrt(2) - 1) / (mpmath.sqrt(2) + 1)) ** 2 * (1 + mpf(2) ** -30)


def q(z):
    if z < mpf(10) ** -12:
        return c * (mpf(1) / 3 + z / 5)
    f = mpmath.sqrt(z)
    return (c * mpmath.atanh(f) / f - c) / z


show("kLog2", q, mpf(0), largest, 7)
