"""Specimens of a study, disc by disc: bands from bottom to top, contacts, stresses, distances. Needs python3-h5py and python3-numpy."""
import json

import h5py
import numpy as np

BANDS = 20
STIFFNESS = 3e8  # k_n of the scenes here [N/m per m]


class Specimen:
    def __init__(self, path):
        with h5py.File(path) as file:
            self.made = json.loads(bytes(file["provenance"][()]).decode())["generate"]
            self.x, self.y, self.radius = (file["particles"][name][()] for name in ("x", "y", "radius"))
            place = np.argsort(file["particles/id"][()])
            self.first, self.second = (place[file["contacts"][name][()]] for name in ("id_a", "id_b"))
            self.left, self.right, self.bottom, self.top = (file.attrs[name] for name in ("left", "right", "bottom", "top"))
            self.d50 = self.made["d50_m"]
        away_x, away_y = self.x[self.second] - self.x[self.first], self.y[self.second] - self.y[self.first]
        distance = np.hypot(away_x, away_y)
        self.overlap = self.radius[self.first] + self.radius[self.second] - distance
        touching = self.overlap > 0
        self.first, self.second, self.overlap = self.first[touching], self.second[touching], self.overlap[touching]
        self.branch = away_x[touching], away_y[touching]
        self.direction = np.arctan2(self.branch[1], self.branch[0])

    @property
    def contacts_of_discs(self):
        return np.bincount(np.concatenate([self.first, self.second]), minlength=len(self.x))

    def void_ratios_of_bands(self):
        """Void ratio of BANDS horizontal bands, discs cut where a band ends."""
        edges = np.linspace(self.bottom, self.top, BANDS + 1)

        def area_below(edge):
            s = np.clip((edge - self.y) / self.radius, -1, 1)
            return (self.radius**2 * (np.arccos(-s) + s * np.sqrt(1 - s * s))).sum()

        band = (self.top - self.bottom) / BANDS * (self.right - self.left)
        return band / np.diff([area_below(edge) for edge in edges]) - 1

    def stresses_of_bands(self):
        """Lateral and vertical stress that normal forces of contacts come to in each band [Pa]; a contact counts where it lies."""
        force = STIFFNESS * self.overlap / np.hypot(*self.branch)
        middle = (self.y[self.first] + self.y[self.second]) / 2
        band = np.clip(((middle - self.bottom) / (self.top - self.bottom) * BANDS).astype(int), 0, BANDS - 1)
        area = (self.top - self.bottom) / BANDS * (self.right - self.left)
        return [np.bincount(band, force * b * b, BANDS) / area for b in self.branch]

    def radial_distribution(self, bins):
        """Pairs at a distance over those of discs thrown at random, of discs five d50 and more from the walls.
        @param bins  edges of the distances, in d50"""
        margin = bins[-1] * self.d50
        inner = np.flatnonzero((np.abs(self.x - (self.left + self.right) / 2) < (self.right - self.left) / 2 - margin) &
                               (np.abs(self.y - (self.bottom + self.top) / 2) < (self.top - self.bottom) / 2 - margin))[::5]
        counts = np.zeros(len(bins) - 1)
        for part in np.array_split(inner, max(1, len(inner) // 100)):
            distance = np.hypot(self.x[part, None] - self.x, self.y[part, None] - self.y) / self.d50
            counts += np.histogram(distance[distance > 0], bins)[0]
        density = len(self.x) / ((self.right - self.left) * (self.top - self.bottom)) * self.d50**2
        return counts / (len(inner) * density * np.pi * np.diff(bins**2))
