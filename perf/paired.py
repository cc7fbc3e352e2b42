"""Means, paired differences and their 95 % intervals, for the scripts of this folder."""
import math

# Student's t at 97.5 % for 1 .. 30 degrees of freedom; above, half_width_factor() has the first terms of its expansion in their inverse.
T = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
     2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042]


def half_width_factor(freedom):
    """Student's t at 97.5 % for this many degrees of freedom, to 1e-3 or better."""
    if freedom <= len(T):
        return T[freedom - 1]
    z = 1.959964
    return z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)


def deviation(values):
    """Standard deviation of a sample; nan for less than two values."""
    n = len(values)
    if n < 2:
        return float("nan")
    mean = sum(values) / n
    return math.sqrt(sum((v - mean) ** 2 for v in values) / (n - 1))


def mean_and_half_width(values):
    """Mean and half of its 95 % confidence interval; nan for the half of a single value."""
    n = len(values)
    mean = sum(values) / n
    return mean, half_width_factor(n - 1) * deviation(values) / math.sqrt(n) if n > 1 else float("nan")


def paired_difference(first, second):
    """(mean of `first`, mean of `second` less `first`, half of its 95 % interval, pairs) over the keys (specimens) that two dicts share."""
    keys = sorted(first.keys() & second.keys())
    if not keys:
        return None
    mean = sum(first[k] for k in keys) / len(keys)
    change, half = mean_and_half_width([second[k] - first[k] for k in keys])
    return mean, change, half, len(keys)
