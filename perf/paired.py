"""Means, paired differences and their 95 % intervals, for the scripts of this folder."""
import math

# Student's t at 97.5 % for 1 .. 30 degrees of freedom.
T = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
     2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042]


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
    return mean, T[min(n - 2, 29)] * deviation(values) / math.sqrt(n) if n > 1 else float("nan")


def paired_difference(first, second):
    """(mean of `first`, mean of `second` less `first`, half of its 95 % interval, pairs) over the keys (specimens) that two dicts share."""
    keys = sorted(first.keys() & second.keys())
    if not keys:
        return None
    mean = sum(first[k] for k in keys) / len(keys)
    change, half = mean_and_half_width([second[k] - first[k] for k in keys])
    return mean, change, half, len(keys)
