"""Student's t distribution, for confidence intervals of means of few runs."""

import math


def central_probability(t, freedom):
    """The probability that |T| <= t, for a whole number of degrees of freedom (Abramowitz and Stegun 26.7.3 and 26.7.4)."""
    angle = math.atan(t / math.sqrt(freedom))
    sine, cosine = math.sin(angle), math.cos(angle)
    is_odd = freedom % 2 == 1
    term = cosine if is_odd else 1.0
    total = term if freedom > 1 else 0.0
    for k in range(3 if is_odd else 2, freedom, 2):
        term *= cosine * cosine * (k - 1) / k
        total += term
    return 2 / math.pi * (angle + sine * total) if is_odd else sine * total


def t_quantile(confidence, freedom):
    """The t of a two-sided interval: |T| <= t with the probability `confidence`."""
    lower, upper = 0.0, 1.0
    while central_probability(upper, freedom) < confidence:
        lower, upper = upper, 2 * upper
    while True:
        middle = (lower + upper) / 2
        if middle in (lower, upper):
            return middle
        if central_probability(middle, freedom) < confidence:
            lower = middle
        else:
            upper = middle
