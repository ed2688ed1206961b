"""A Latin hypercube sample (McKay, Beckman and Conover 1979), the same on every machine."""

import random


def latin_hypercube(points, dimensions, seed):
    """`points` lists of `dimensions` numbers in [0, 1): each of the `points` intervals of equal length holds one number of each
    dimension, at random within it. The generator is Python's Mersenne Twister through random() alone, whose numbers for a seed are
    guaranteed to stay; shuffle() and sample() are not.
    """
    draw = random.Random(seed).random
    columns = []
    for _ in range(dimensions):
        strata = list(range(points))
        for last in range(points - 1, 0, -1):  # Fisher and Yates
            chosen = int(draw() * (last + 1))
            strata[last], strata[chosen] = strata[chosen], strata[last]
        columns.append([(stratum + draw()) / points for stratum in strata])
    return [list(row) for row in zip(*columns)]
