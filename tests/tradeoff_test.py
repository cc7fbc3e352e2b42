"""The tables of perf/reports/0.1/accuracy.md: planted tests give the planted differences and intervals: tradeoff_test.py PROJECT"""
import csv
import json
import math
import random
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(sys.argv[1])
sys.path[:0] = [str(PROJECT / "perf"), str(PROJECT / "perf" / "tradeoff"), str(PROJECT / "perf" / "tradeoff" / "outside")]

import collect  # noqa: E402
import compare  # noqa: E402
import paired  # noqa: E402
import picture  # noqa: E402
import table  # noqa: E402
import two_rates  # noqa: E402
import verify  # noqa: E402

SCENE = {"specimen": {"aspect_ratio": 2.0}, "grains": {"normal_stiffness": 3e8}, "damping": {"local": 0.3, "viscous_ratio": 0.0}, "hydrate": {"saturation": 0.55},
         "run": {"precision": "double", "time_step_safety": 0.95, "rotational_inertia_factor": 1.0, "mass_scaled_fraction": 0.0, "verlet_skin": 0.0},
         "test": {"confining_stress": 1e6, "inertial_number": 1e-4}}


def plant(folder, seed, numbers, q, finished=True, energy=False, rate=1e-4, **run):
    """A member as `clathra study` leaves it: `q` of the walls and of the contacts, a row each."""
    member = folder / f"members/{len(list(folder.glob('members/*')))}"
    member.mkdir(parents=True)
    scene = {**SCENE, "run": {**SCENE["run"], **run}, "test": {**SCENE["test"], "inertial_number": rate}}
    document = {"scene": scene, "seed": seed, "particle_steps": 1000, "input": {"specimen_digest_xxh3_128": f"{seed:x}".ljust(32, "0")},
                "stages": {"plan": {"particles": 2000.0, "inertial_number": rate}, "shear": numbers}, "exit": {"reason": "finished" if finished else "stopped"}}
    (member / "run.json").write_text(json.dumps(document))
    with open(member / "history.csv", "w", newline="") as file:
        rows = csv.writer(file)
        ledger = ["boundary_work_J_per_m"] + [f"{name}_J_per_m" for name in collect.LEDGER] if energy else []
        rows.writerow(["eps1", "q_Pa", "contact_sigma1_Pa", "contact_sigma3_Pa", "platen_wave_stress"] + ledger)
        for number, (walls, contacts) in enumerate(q):
            rows.writerow([0.01 * number, walls, contacts + 1e6, 1e6, 0.04] + ([4, 2, 0, 1, 0.5, 0, 0.25] if energy else []))


class Tradeoff(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def collected(self):
        collect.main(self.folder, self.folder / "data.csv")
        return compare.Tests(compare.load(self.folder / "data.csv"))

    def test_students_factor_goes_on_beyond_thirty(self):
        for freedom, factor in ((1, 12.706), (30, 2.042), (31, 2.0395), (39, 2.0227), (59, 2.0010), (199, 1.9720)):
            self.assertAlmostEqual(paired.half_width_factor(freedom), factor, delta=6e-4)

    def test_a_planted_difference_is_found_on_the_same_specimens(self):
        # Specimens scatter by 10 %, the option adds exactly 0.3, 0.4 and 0.5 MPa: paired, 0.4 +- 4.303 * 0.1 / sqrt(3).
        for seed, q in ((1, 9e6), (2, 10e6), (3, 11e6)):
            plant(self.folder / "a", seed, {"peak_q_Pa": q, "end_eps1": 0.1}, [(0, 0)])
            plant(self.folder / "b", seed, {"peak_q_Pa": q + 2e5 + seed * 1e5, "end_eps1": 0.1}, [(0, 0)], rotational_inertia_factor=3.0)
        plant(self.folder / "b", 4, {"peak_q_Pa": 99e6, "end_eps1": 0.1}, [(0, 0)], rotational_inertia_factor=3.0)  # no partner
        plant(self.folder / "a", 5, {"peak_q_Pa": 12e6, "end_eps1": 0.1}, [(0, 0)])
        plant(self.folder / "b", 5, {"peak_q_Pa": 99e6, "end_eps1": 0.1}, [(0, 0)], finished=False, rotational_inertia_factor=3.0)
        change, half, pairs = self.collected().change(0.55, ("inertia_scaling", "3", 1e-4), "peak_q_Pa", compare.BASE)
        self.assertEqual(pairs, 3)
        self.assertAlmostEqual(change, 100 * 0.4 / 10, places=4)
        self.assertAlmostEqual(half, 100 * 4.303 * 0.1 / math.sqrt(3) / 10, places=4)

    def test_the_interval_of_five_holds_a_planted_mean_in_95_of_100(self):
        random.seed(7)
        held = 0
        for _ in range(4000):
            specimens = {k: random.gauss(10, 1) for k in range(5)}
            _, change, half, _ = paired.paired_difference(specimens, {k: v + random.gauss(0.2, 0.1) for k, v in specimens.items()})
            held += abs(change - 0.2) <= half
        self.assertAlmostEqual(held / 4000, 0.95, delta=0.0105)  # three standard deviations

    def test_what_follows_the_peak_counts_only_where_the_test_went_there(self):
        plant(self.folder / "a", 1, {"peak_q_Pa": 9e6, "residual_q_Pa": 2e6, "end_eps1": 0.04}, [(0, 0)])
        plant(self.folder / "a", 2, {"peak_q_Pa": 9e6, "residual_q_Pa": 3e6, "end_eps1": 0.1}, [(0, 0)])
        tests = self.collected()
        self.assertEqual(list(tests.values(0.55, compare.BASE, "residual_q_Pa").values()), [3])
        self.assertEqual(len(tests.values(0.55, compare.BASE, "peak_q_Pa")), 2)

    def test_a_test_that_two_parts_share_is_one_with_all_that_is_known(self):
        plant(self.folder / "a", 1, {"peak_q_Pa": 9e6, "end_eps1": 0.1}, [(0, 0), (9, 8), (2, 8.5)])
        plant(self.folder / "b", 1, {"peak_q_Pa": 9e6, "end_eps1": 0.04}, [(0, 0), (9, 8)], energy=True)
        rows = collect.collect(self.folder)
        self.assertEqual(len(rows), 1)
        self.assertEqual((rows[0]["end_eps1"], rows[0]["damping_share"], rows[0]["breakage_share"]), ("0.1", "0.5", "0.25"))
        self.assertEqual((rows[0]["contact_peak_q_Pa"], rows[0]["contact_peak_eps1"], rows[0]["contact_q_at_peak_Pa"]), ("8.5", "0.02", "8"))

    def test_a_part_that_runs_later_is_added_to_the_table(self):
        plant(self.folder / "a", 1, {"peak_q_Pa": 9e6, "end_eps1": 0.1}, [(0, 0)])
        collect.main(self.folder, self.folder / "data.csv")
        before = (self.folder / "data.csv").read_text()
        shutil.rmtree(self.folder / "a")
        plant(self.folder / "b", 1, {"peak_q_Pa": 8e6, "end_eps1": 0.1}, [(0, 0)], rotational_inertia_factor=3.0)
        collect.main(self.folder, self.folder / "data.csv")
        after = (self.folder / "data.csv").read_text()
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(len(after.splitlines()), 3)
        collect.main(self.folder, self.folder / "data.csv")  # the same once more changes nothing
        self.assertEqual((self.folder / "data.csv").read_text(), after)

    def test_verdicts_say_when_they_hang_on_the_seeds(self):
        self.assertEqual([compare.verdict(found, 2) for found in ((1, 0.9, 5), (-1, 1.1, 5), (3, 0.9, 5), (3, 1.1, 5), (0, math.nan, 1), None)],
                         ["within", "open", "outside", "open", "-", "-"])

    def test_strength_of_two_stresses_is_that_of_their_circles(self):
        # c = 2 MPa and phi = 30 deg: K_p = 3, q = (K_p - 1) sigma_3 + 2 c sqrt(K_p).
        first, second = ({"x": 2 * s + 4 * math.sqrt(3)} for s in (1, 3))
        (cohesion, angle), = compare.strength(first, second, (1, 3)).values()
        self.assertAlmostEqual(cohesion, 2)
        self.assertAlmostEqual(angle, 30)

    def test_a_fast_rise_gains_what_its_share_of_the_strain_allows(self):
        # 15 % at 2e-4; 3 % of it five times as fast: 15 / (12 + 3 / 5). A test that ends in the rise gains all of it.
        self.assertAlmostEqual(two_rates.largest_gain(0.03, 1e-3, 0.15), 15 / 12.6)
        self.assertAlmostEqual(two_rates.largest_gain(0.03, 1e-3, 0.02), 5)
        self.assertAlmostEqual(two_rates.largest_gain(0.03, two_rates.FIXED, 0.15), 1)

    def test_the_rise_is_as_fast_as_leaves_its_modulus(self):
        # E50 +0.6 and +0.8 % at 1e-3: 0.7 +- 12.706 * 0.1 is open; by +0.68 and +0.72 % it is kept. +4 % at 3e-3 is not.
        for seed, at_1e3 in ((1, 6.8e5), (2, 7.2e5)):
            for rate, modulus in ((2e-4, 1e8), (1e-3, 1e8 + at_1e3), (3e-3, 1.04e8)):
                plant(self.folder / f"{rate}", seed, {"peak_q_Pa": 4e6, "secant_modulus_Pa": modulus, "end_eps1": 0.1}, [(0, 0)], rate=rate)
        tests = self.collected()
        self.assertEqual(two_rates.fastest_rise(tests, 0.55), 1e-3)
        self.assertEqual(two_rates.fastest_rise(tests, 0.55, within=0.5), two_rates.FIXED)
        self.assertAlmostEqual(two_rates.half_peak_strain(tests, 0.55, two_rates.plain(2e-4)), 2e6 / 1e8)

    def test_what_is_said_key_by_key_quotes_the_committed_data(self):
        tests, page = compare.Tests(compare.load(PROJECT / "perf/tradeoff/data.csv")), (PROJECT / "docs/explanation/accuracy.md").read_text()
        sand, bonded = table.SAND, table.BONDED

        def peak(saturation, factor, level, rate, against):
            change, half, _ = tests.change(saturation, (factor, level, rate), "peak_q_Pa", against)
            return f"{change:.1f} ± {half:.1f}".replace("-0.0 ", "0.0 ")

        plain = two_rates.plain
        quoted = {"inertial_number": [peak(material, *plain(rate), compare.REFERENCE) for material in (sand, bonded) for rate in (1e-3, 5e-4, 2e-4)],
                  "precision": [peak(material, "precision", "mixed", 1e-4, plain(1e-4)) for material in (sand, bonded)],
                  "time_step_safety": [peak(bonded, "dt_safety", "0.475", 2e-4, plain(2e-4))],
                  "local": [peak(bonded, "damping", "0.7", 2e-4, plain(2e-4))],
                  "rotational_inertia_factor": [peak(material, "inertia_scaling", "3", 2e-4, plain(2e-4)) for material in (sand, bonded)],
                  "mass_scaled_fraction": [peak(bonded, "inertia_scaling+mass_scaling", "3+0.25", 2e-4, plain(2e-4))]}
        for key, numbers in quoted.items():
            row = next(text for text in " ".join(page.split()).split(" - **") if text.startswith(f"`{key}`**")).replace(" %", "")
            for number in numbers:
                self.assertIn(number, row)

        structures = (PROJECT / "src/domain/scene/scene.hpp").read_text()  # each docstring quotes one or two of them
        for number in (quoted["inertial_number"][0], quoted["inertial_number"][2], quoted["precision"][1], quoted["time_step_safety"][0],
                       quoted["rotational_inertia_factor"][1], quoted["mass_scaled_fraction"][0], peak(bonded, "damping", "0", 2e-4, plain(2e-4))):
            self.assertIn(number.replace("±", "+-") + " %", structures)

    def test_what_tune_chose_is_compared_with_its_reference(self):
        scene = self.folder / "planted.toml"
        (self.folder / "planted-5.toml").write_text("[test]\ninertial_number = 0.001\nconfining_stress = 2e6\n[run]\nprecision = 'mixed'\n")
        text = verify.study(scene, self.folder)
        self.assertIn('[groups.tuned5]\n"run.precision" = "mixed"\n"test.inertial_number" = 0.001', text)
        self.assertNotIn("tuned1", text)
        self.assertNotIn("confining_stress", text)
        (self.folder / "planted-5.done").write_text("0 203\n")
        (self.folder / "planted-1.done").write_text("77 59\n")
        (self.folder / "planted-1.log").write_text("study 91%\nundetermined: needs about 81 seeds (22:35 more at I = 3e-05)\n")
        (self.folder / "planted-verified").mkdir()
        # Groups of 100, 110 and 90 MPa in the reference and 3, 4 and 5 MPa more: +4 +- 4.303 / sqrt(3) MPa of 100.
        lines = [f"member,{group},{seed},{1e6 * (q + more)}" for seed, q, extra in ((101, 100, 3), (102, 110, 4), (103, 90, 5))
                 for group, more in (("reference", 0), ("tuned5", extra))]
        (self.folder / "planted-verified/study.csv").write_text("\n".join(["row,group,seed,peak_q_Pa", *lines, "mean,reference,,99e6"]))
        with open(self.folder / "outside.csv", "w") as out:
            verify.table(self.folder, out)
        with open(self.folder / "outside.csv") as file:
            none, found = csv.DictReader(file)
        self.assertEqual((none["tune_said"], none["pairs"]), ("undetermined: needs about 81 seeds (22:35 more at I = 3e-05)", "0"))
        self.assertEqual((found["reference_peak_q_MPa"], found["change_pct"], found["half_width_pct"], found["pairs"]), ("100.000", "4.00", "2.48", "3"))

    def test_the_front_holds_what_nothing_beats_in_both(self):
        self.assertEqual(picture.front({(1, 9), (2, 5), (3, 6), (4, 1), (5, 1)}), {(1, 9), (2, 5), (4, 1)})

    def test_the_page_is_what_the_committed_data_give(self):
        report = PROJECT / "perf/reports/0.1"
        (self.folder / "pictures").mkdir()
        shutil.copy(report / "accuracy.md", self.folder)
        table.main(PROJECT / "perf/tradeoff/data.csv", PROJECT / "perf/tradeoff/cost.csv", self.folder)
        two_rates.main(PROJECT / "perf/tradeoff/data.csv", self.folder)
        for name in ("accuracy.md", "pictures/work-precision.svg", "pictures/two-rates.svg"):
            self.assertEqual((self.folder / name).read_text(), (report / name).read_text(), f"run perf/tradeoff/table.py, two_rates.py: {name}")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
