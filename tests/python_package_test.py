"""The package clathra of share/python, with a real run and a real study: python_package_test.py CLATHRA PROJECT FOLDER"""
import os
import shutil
import sys
import unittest

CLATHRA, PROJECT, FOLDER = sys.argv[1:4]
sys.path.insert(0, os.path.join(PROJECT, "share", "python"))
os.environ["CLATHRA"] = CLATHRA

import clathra  # noqa: E402
import numpy as np  # noqa: E402

SCENE = {"specimen": {"file": os.path.join(PROJECT, "tests", "golden", "specimen.h5")},
         "hydrate": {"saturation": "55 %"}, "bond": {"preset": "first_crack"}, "test": {"axial_strain": 0.02},
         "output": {"records": 20, "snapshots": 2, "snapshots_at": ["0.5 %"], "energy": True, "event_details": True}}


class Package(unittest.TestCase):
    said = []

    @classmethod
    def setUpClass(cls):
        os.chdir(FOLDER)
        for folder in ("run", "study", "failing", "stopped"):  # of a program before this one
            shutil.rmtree(folder, ignore_errors=True)
        cls.run_of_scene = clathra.run(SCENE, "run", threads=1)
        base = {key: value for key, value in SCENE.items() if key != "output"}
        base["specimen"] = {"particles": np.int64(100), "void_ratio": np.float64(0.28), "compaction_layers": 1}
        with open("base.toml", "w", encoding="utf-8") as file:
            file.write(clathra.program._toml(base))
        cls.study = clathra.study({"scene": "base.toml", "seeds": 2, "matrix": {"output.records": 10, "test.confining_stress": {
            "from": "1 MPa", "to": "2 MPa", "count": 2}}}, "study", progress=cls.said.append)

    def test_history_is_a_table_with_units(self):
        run = self.run_of_scene
        self.assertTrue(run.finished)
        self.assertEqual(len(run.history), 21)
        self.assertEqual(len(run.consolidation) + 21, len(run.stages))
        self.assertEqual(run.consolidation["void_ratio"].iloc[-1], run.history["void_ratio"].iloc[0])
        self.assertTrue(run.consolidation["boundary_work_J_per_m"].isna().all())
        self.assertTrue(run.history["boundary_work_J_per_m"].notna().all())
        self.assertEqual([set(rows["stage"]) for rows in (run.consolidation, run.history)], [{"consolidation"}, {"shear"}])
        np.testing.assert_allclose(run.history["q_Pa"], run.history["sigma1_Pa"] - run.history["sigma3_Pa"], rtol=1e-12, atol=1e-6)
        self.assertEqual(run.history["largest_q_Pa"].max(), run.numbers["peak_q_Pa"])
        units = run.history.attrs["units"]
        self.assertEqual([units[name] for name in ("q_Pa", "time_s", "eps1", "boundary_work_J_per_m", "bonds_intact_pct")], ["Pa", "s", "", "J/m", "%"])
        self.assertEqual([clathra.units_of(name) for name in ("step", "strain_rate_per_s", "peak_curvature_per_Pa", "dilation_angle_deg", "temperature_degC", "boundary_K")],
                         ["", "1/s", "1/Pa", "deg", "degC", "K"])

    def test_snapshots_are_arrays_with_units(self):
        run = self.run_of_scene
        self.assertEqual(len(run.snapshots), 4)
        self.assertAlmostEqual(run.snapshot_at(0.005).eps1, 0.005, delta=4e-6)  # one step
        last = run.snapshots[-1]
        self.assertEqual(last.particles["position"].shape, (100, 2))
        self.assertEqual(len(last.particles), 100)
        self.assertEqual(last.particles.units["position"], "m")
        left, right, bottom, top = last.walls
        self.assertTrue(left < last.particles["position"][:, 0].min() and last.particles["position"][:, 1].max() < top)
        self.assertEqual(np.count_nonzero(last.contacts["state"] == 1), run.history["bonds_intact"].iloc[-1])
        self.assertEqual(sum(len(snapshot.events) for snapshot in run.snapshots), len(run.events))
        with self.assertRaises(AttributeError):
            last.nothing

    def test_events_have_details_with_units(self):
        run = self.run_of_scene
        self.assertEqual(len(run.events.columns), 14)
        units = run.events.attrs["units"]
        self.assertEqual([units[name] for name in ("eps1", "orientation_deg", "width_m", "utilisation", "energy_J_per_m", "relative_rotation_rad")],
                         ["", "deg", "m", "", "J/m", "rad"])
        self.assertGreaterEqual(run.events["utilisation"].min(), 1)
        energy = np.concatenate([snapshot.events["energy"] for snapshot in run.snapshots])
        np.testing.assert_array_equal(energy, run.events["energy_J_per_m"])
        self.assertEqual(run.snapshots[-1].events.units["energy"], "J/m")

    def test_specimens_are_arrays(self):
        final = self.run_of_scene.final
        self.assertEqual(final.particles["x"].shape, (100,))
        self.assertAlmostEqual(final.axial_strain, 0.02, delta=4e-6)
        with self.assertRaises(FileNotFoundError):
            _ = self.run_of_scene.specimen
        with self.assertRaises(ValueError):
            clathra.Snapshot(final.path)

    def test_study_has_members_means_and_intervals(self):
        study = self.study
        self.assertEqual(list(study.members["group"]), ["1MPa", "1MPa", "2MPa", "2MPa"])
        peaks = study.interval("peak_q_Pa")
        self.assertEqual(list(peaks.columns), ["group", "n", "mean", "standard_deviation", "low", "high"])
        own = [run.history["largest_q_Pa"].max() for run in study.runs("1MPa")]
        self.assertAlmostEqual(peaks["mean"][0], np.mean(own))
        self.assertTrue((peaks["low"] <= peaks["mean"]).all())
        self.assertEqual(study.means["n"][0], 2)
        self.assertEqual(list(study.members["test.confining_stress"]), [1e6, 1e6, 2e6, 2e6], "numbers in SI units")
        self.assertEqual(list(study.members["label"]), ["1 MPa", "1 MPa", "2 MPa", "2 MPa"])
        self.assertTrue(any("study" in line and "%" in line for line in self.said), "progress")
        self.assertEqual(study.run("2MPa", 2).scene["test"]["confining_stress"], 2e6)
        for wrong in (lambda: study.interval("nothing"), lambda: study.runs("3MPa")):
            with self.assertRaises(KeyError):
                wrong()

    def test_errors_say_what_the_program_said(self):
        with self.assertRaisesRegex(clathra.ClathraError, "unknown key 'particels'.*did you mean 'particles'") as caught:
            clathra.run({"specimen": {"particels": 20}}, "wrong")
        self.assertEqual(caught.exception.code, 65)
        with self.assertRaises(TypeError):
            clathra.run({"specimen": {"particles": None}}, "wrong")
        with self.assertRaises(ValueError):
            clathra.run({"specimen": {"particles": float("nan")}}, "wrong")
        for function in (clathra.open_run, clathra.open_study):
            with self.assertRaises(FileNotFoundError):
                function("nowhere")


    def test_numbers_of_numpy_are_numbers(self):
        scene = {"specimen": {"particles": np.int32(20), "void_ratio": np.float32(0.25)}, "output": {"energy": np.bool_(True), "snapshots_at": np.array([0.01, 0.02])}, "hydrate": {"saturation": np.array(0.5)}}
        text = clathra.program._toml(scene)
        for line in ('"particles" = 20', '"void_ratio" = 0.25', '"energy" = true', '"snapshots_at" = [0.01, 0.02]', '"saturation" = 0.5'):
            self.assertIn(line + "\n", text)

    def test_check_gives_the_verdict_and_all_problems(self):
        valid = clathra.check({"specimen": {"particles": 300}}, set=["test.axial_strain=1 %"])
        self.assertEqual(valid["verdict"], "valid")
        self.assertAlmostEqual(valid["forecast"]["particles"], 300, delta=1)
        wrong = clathra.check({"specimen": {"particles": 300}, "grains": {"friktion": 0.4}, "test": {"axial_strain": 15}})
        self.assertEqual((wrong["verdict"], len(wrong["problems"])), ("invalid", 2))
        self.assertIn("did you mean 'friction'?", wrong["problems"][0]["text"])
        missing = clathra.check("nowhere.toml")
        self.assertEqual((missing["verdict"], missing["exit_code"]), ("invalid", 66))
        self.assertEqual((missing["problems"][0]["file"], missing["problems"][0]["severity"]), ("nowhere.toml", "missing file"))

    def test_runs_of_a_group_that_failed_are_none(self):
        with self.assertRaises(clathra.ClathraError) as caught:
            clathra.study({"scene": "base.toml", "seeds": 1, "matrix": {"specimen.void_ratio": [np.float64(0.1), 0.28]}}, "failing", progress=False)
        self.assertEqual(caught.exception.code, 78)
        study = clathra.open_study("failing")
        self.assertEqual([len(study.runs(group)) for group in study.members["group"]], [0, 1])

    def test_an_interrupt_leaves_a_checkpoint(self):
        def interrupt(line):
            if line.startswith("shear"):
                raise KeyboardInterrupt

        long = {**SCENE, "test": {"axial_strain": 0.02, "inertial_number": 1e-6}}
        with self.assertRaises(KeyboardInterrupt):
            clathra.run(long, "stopped", progress=interrupt, threads=1)
        self.assertTrue(os.path.exists(os.path.join("stopped", "ckpt", "0.json")))
        self.assertFalse(clathra.open_run("stopped").finished)

    def test_the_builtin_open_is_not_hidden(self):
        names = {}
        exec("from clathra import *", names)
        self.assertNotIn("open", names)
        self.assertFalse(hasattr(clathra, "open"))


unittest.main(argv=sys.argv[:1])
