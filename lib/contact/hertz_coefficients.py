"""Prints the coefficients of hertz_coefficients.hpp: rational functions that interpolate at Chebyshev nodes, in 60 digits (mpmath)."""

import mpmath
from mpmath import mpf

mpmath.mp.dps = 60
DEGREE = 5
SAMPLES = 200


def ratio_and_correction(k):
    """R'/R'' of an ellipse with the axis ratio k = b/a < 1, and its F2. Johnson, Contact Mechanics, section 4.2(c)."""
    K, E = mpmath.ellipk(1 - k**2), mpmath.ellipe(1 - k**2)
    along, across = K - E, E / k**2 - K
    F1 = mpmath.cbrt(4 / (mpmath.pi * (1 - k**2)) * mpmath.sqrt(k**3 * along * across))
    return across / along, 2 / mpmath.pi * mpmath.sqrt(k) / F1 * K


def correction(ratio):
    wanted = mpmath.log(ratio)
    excess = lambda x: mpmath.log(ratio_and_correction(mpmath.exp(x))[0]) - wanted
    return ratio_and_correction(mpmath.exp(mpmath.findroot(excess, (-0.67 * wanted, -0.6 * wanted), tol=1e-80)))[1]


def interpolate(function):
    """P and Q with P/Q = function at the Chebyshev nodes of [0, 1]. Lowest coefficient first, and Q[0] = 1."""
    count = 2 * DEGREE + 1
    nodes = [(1 + mpmath.cos(mpmath.pi * (2 * i + 1) / (2 * count))) / 2 for i in range(count)]
    values = [function(x) for x in nodes]
    rows = [[x**j for j in range(DEGREE + 1)] + [-y * x**j for j in range(1, DEGREE + 1)] for x, y in zip(nodes, values)]
    solution = list(mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(values)))
    return solution[: DEGREE + 1], [mpf(1)] + solution[DEGREE + 1 :]


def show(octave):
    """The octave of sqrt(ratio) from 2^octave. Prints a row, and the largest relative error with rounded coefficients."""
    function = lambda t: correction(((1 + t) * mpf(2) ** octave) ** 2)
    P, Q = ([mpf(float(c)) for c in part] for part in interpolate(function))
    error = max(
        abs(mpmath.polyval(P[::-1], t) / mpmath.polyval(Q[::-1], t) / function(t) - 1)
        for t in (mpf(2 * k + 1) / (2 * SAMPLES) for k in range(SAMPLES))
    )
    # Sums of positive terms lose no digits.
    assert min(P + Q) > 0
    print("    {{" + ", ".join(repr(float(c)) for c in P) + "},")
    print("     {" + ", ".join(repr(float(c)) for c in Q[1:]) + f"}}}},  // {mpmath.nstr(error, 2)}")


for number in range(10):
    show(number)
