import ast
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from typing import Callable, Iterable, List, Set, Tuple, Type

import numpy as np

import skel

DATASETS = pathlib.Path(os.environ["SKEL_DATASETS"])
BIN = pathlib.Path(os.environ["SKEL_BIN"])
BOY = DATASETS / "characters" / "cap_boy.png"
boy = skel.rig(BOY)


class TestRigging(unittest.TestCase):
    def test_a_glb_is_that_of_the_tool(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([BIN / "skel-infer", BOY, "-o", folder, "--formats", "glb"], check=True, stdout=subprocess.DEVNULL)
            ours = pathlib.Path(folder) / "cap_boy.glb"
            tools = ours.read_bytes()
            boy.save(ours)
            self.assertEqual(ours.read_bytes(), tools)

    def test_arrays_have_the_shapes_that_are_told(self) -> None:
        joints, vertices, triangles = len(boy.joints), len(boy.mesh.vertices), len(boy.mesh.triangles)
        self.assertEqual(boy.image.shape, (*boy.mask.shape, 4))
        self.assertEqual(boy.mesh.vertices.shape, (vertices, 3))
        self.assertEqual(boy.mesh.uv.shape, (triangles, 3, 2))
        self.assertEqual(boy.weights.shape, (vertices, joints))
        np.testing.assert_allclose(boy.weights.sum(axis=1), 1, atol=1e-5)
        self.assertLessEqual((boy.weights > 0).sum(axis=1).max(), 4)
        self.assertEqual(boy.joints[0].parent, -1)
        self.assertTrue(all(0 <= joint.confidence <= 1 for joint in boy.joints))
        self.assertEqual(set(np.unique(boy.mask)), {0, 255})
        self.assertEqual(boy.classes.shape, (len(boy.candidates), 4))
        self.assertEqual({clip.name for clip in boy.clips} >= {"walk", "dance"}, True)

    def test_an_array_is_rigged_as_its_file(self) -> None:
        again = skel.rig(boy.image)
        self.assertEqual(again.to_glb(), boy.to_glb())
        masked = skel.rig(boy.image, mask=boy.mask > 0)
        self.assertEqual(masked.mask.shape, boy.mask.shape)

    def test_a_joint_that_is_moved_stays_there(self) -> None:
        hand = next(joint for joint in boy.joints if joint.name == "left_hand")
        moved = boy.with_joints({"left_hand": hand.image + [3, -4]})
        there = next(joint for joint in moved.joints if joint.name == "left_hand")
        np.testing.assert_allclose(there.image, hand.image + [3, -4])
        self.assertEqual(there.origin, "edited")

    def test_errors_are_exceptions_with_the_sentence_of_the_tool(self) -> None:
        missing = "no/such/hero.png"
        said = subprocess.run([BIN / "skel-infer", missing], capture_output=True, text=True).stderr.strip()
        with self.assertRaises(skel.InputError) as raised:
            skel.rig(missing)
        self.assertIn(str(raised.exception), said)
        self.assertIsInstance(raised.exception, skel.Error)
        blank = np.full((64, 64, 3), 255, np.uint8)
        cases: List[Tuple[Callable[[], object], Type[skel.Error], str]] = [
            (lambda: skel.rig(blank), skel.InputError, "image"),
            (lambda: skel.rig(np.zeros((4, 4, 7), np.uint8)), skel.UsageError, "shape (4, 4, 7)"),
            (lambda: skel.rig(np.zeros((0, 4), np.uint8)), skel.UsageError, "shape (0, 4)"),
            (lambda: skel.rig(np.zeros((20_000, 6_000), np.uint8)), skel.UsageError, "100000000 pixels"),
            (lambda: skel.rig(np.zeros((4, 4), np.float32)), skel.UsageError, "uint8"),
            (lambda: skel.rig(3), skel.UsageError, "image"),  # type: ignore[arg-type]
            (lambda: skel.rig(BOY, skin="rubber"), skel.UsageError, "geodesic"),
            (lambda: skel.rig(BOY, mask=np.ones((2, 2), np.uint8)), skel.InputError, "2x2"),
            (lambda: skel.rig(BOY, figure=0), skel.UsageError, "figure"),
            (lambda: boy.clip("swim"), skel.UsageError, "walk"),
            (lambda: boy.with_joints({"tail": [1, 1]}), skel.UsageError, "tail"),
            (lambda: boy.save("hero.stl"), skel.UsageError, "hero.stl"),
            (lambda: boy.save(BOY / "hero.glb"), skel.OutputError, "cap_boy.png/hero.glb"),
            (lambda: boy.film("walk", size=(1, 1)), skel.UsageError, "size"),
            (lambda: skel.load(BOY), skel.InputError, "cap_boy.png"),
        ]
        for work, kind, words in cases:
            with self.subTest(words=words), self.assertRaises(kind) as caught:
                work()
            self.assertIn(words, str(caught.exception))


class TestMoving(unittest.TestCase):
    def test_a_character_comes_back_from_its_file(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "boy.glb"
            boy.save(path)
            back = skel.load(path)
        np.testing.assert_allclose(back.mesh.vertices.mean(axis=0), boy.mesh.vertices.mean(axis=0), atol=0.05)
        self.assertEqual([clip.name for clip in back.clips], [clip.name for clip in boy.clips])

    def test_poses_move_vertices_and_joints(self) -> None:
        rest = boy.rest_pose()
        np.testing.assert_allclose(boy.vertices(rest), boy.mesh.vertices, atol=1e-5)
        positions = [joint.position for joint in boy.joints]
        np.testing.assert_allclose(boy.joint_positions(rest), positions, atol=1e-5)
        dancing = boy.pose("dance", 0.5)
        self.assertGreater(np.abs(boy.vertices(dancing) - boy.mesh.vertices).max(), 0.05)
        turned = dancing.rotations
        turned[0] = [0, 1, 0, 0]  # half a turn about the vertical
        self.assertTrue(np.isfinite(boy.vertices(skel.Pose(turned))).all())

    def test_poses_that_are_none_are_refused(self) -> None:
        for rotations, words in [(np.zeros((len(boy.joints), 4)), "row 0"), (np.full((len(boy.joints), 4), np.nan), "row 0")]:
            with self.assertRaises(skel.UsageError) as caught:
                skel.Pose(rotations)
            self.assertIn(words, str(caught.exception))
        with self.assertRaises(skel.UsageError):
            boy.vertices(skel.Pose([[0, 0, 0, 1]]))
        with self.assertRaises(skel.UsageError):
            boy.pose("dance", float("nan"))

    def test_motions_are_made_saved_and_retargeted(self) -> None:
        nod = skel.Clip("nod", {"head": ([0, 1], np.array([[0, 0, 0, 1], [0.2, 0, 0, 0.98]]))})
        self.assertEqual(nod.duration_s, 1)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "nod.clip.json"
            nod.save(path)
            self.assertEqual(skel.Clip.load(path).tracks.keys(), {"head"})
            fitted = boy.retarget(path)
            boy.save(pathlib.Path(folder) / "boy.bvh")
            walk = boy.retarget(pathlib.Path(folder) / "boy-walk.bvh")
        self.assertEqual(fitted.name, "nod")
        self.assertAlmostEqual(walk.duration_s, boy.clip("walk").duration_s, delta=0.1)
        self.assertAlmostEqual(boy.retarget("walk").duration_s, boy.clip("walk").duration_s, delta=0.1)
        with self.assertRaises(skel.InputError):
            skel.Clip("back", {"head": ([1, 0], np.array([[0, 0, 0, 1], [0, 0, 0, 1]]))})

    def test_a_film_is_a_sequence_of_frames(self) -> None:
        film = boy.film("dance", fps=5, size=(64, 96))
        self.assertEqual(film[0].shape, (96, 64, 4))
        self.assertEqual(len(list(film)), len(film))
        np.testing.assert_array_equal(film[-1], film[len(film) - 1])
        with self.assertRaises(IndexError):
            film[len(film)]


class TestMany(unittest.TestCase):
    def test_many_come_in_their_order_as_one_by_one(self) -> None:
        paths = sorted(path for path in (DATASETS / "characters").glob("a*.png") if ".mask." not in path.name)[:5]
        counted: List[int] = []
        many = list(skel.rig_many(paths, jobs=2, progress=counted.append))
        self.assertEqual(counted, [1, 2, 3, 4, 5])
        for path, drawing in zip(paths, many):
            assert isinstance(drawing, skel.Drawing)
            self.assertEqual(drawing.to_glb(), skel.rig(path).to_glb())

    def test_errors_are_raised_or_returned(self) -> None:
        paths = [str(BOY), "no.png", str(BOY)]
        kinds = [type(result) for result in skel.rig_many(paths, errors="return", clips=False)]
        self.assertEqual(kinds, [skel.Drawing, skel.InputError, skel.Drawing])
        with self.assertRaises(skel.InputError):
            list(skel.rig_many(paths, clips=False))

    def test_other_threads_run_while_one_rigs(self) -> None:
        ticks = 0
        stop = threading.Event()

        def count() -> None:
            nonlocal ticks
            while not stop.is_set():
                ticks += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = ticks
        skel.rig(BOY)
        during = ticks - before
        stop.set()
        thread.join()
        self.assertGreater(during, 2)


class TestTypes(unittest.TestCase):
    def test_the_stub_names_what_there_is(self) -> None:
        core = sys.modules["skel._core"]
        assert core.__file__
        stub = ast.parse((pathlib.Path(core.__file__).parent / "_core.pyi").read_text())

        def public(names: Iterable[str]) -> Set[str]:
            return {name for name in names if not name.startswith("_")}

        defined = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(defined.keys() | {"CLASSES"}, public(vars(core)))
        for name, node in defined.items():
            if isinstance(node, ast.ClassDef):
                members = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
                members |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name)}
                self.assertEqual(public(members), public(vars(getattr(core, name))), name)
            else:
                told = getattr(core, name).__doc__
                for argument in node.args.args + node.args.kwonlyargs:
                    self.assertIn(f"{argument.arg}: ", told, name)


class TestLearning(unittest.TestCase):
    characters = skel.LabelledSet.load(DATASETS / "characters")

    def test_the_net_is_the_tools(self) -> None:
        net = skel.Net.builtin()
        self.assertEqual(net.sizes, [3, 4, 4, 2])
        classes = net.classify(boy.candidates.features)
        np.testing.assert_allclose(classes, boy.classes, atol=1e-6)
        np.testing.assert_allclose(classes.sum(axis=1), 1, atol=1e-6)
        np.testing.assert_array_equal(skel.candidates(BOY).features, boy.candidates.features)

    def test_a_trained_net_is_that_of_the_tool(self) -> None:
        seen: List[Tuple[int, int, float]] = []
        few = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for file in (DATASETS / "characters").glob("al*"):
            shutil.copy(file, few)

        def progress(done: int, total: int, loss: float) -> None:
            seen.append((done, total, loss))

        training = skel.train(
            skel.LabelledSet.load(few), folds=2, epochs=5, restarts=1, generated=3, seed=7, progress=progress
        )
        self.assertEqual(seen[-1][:2], (15, 15))
        with tempfile.TemporaryDirectory() as folder:
            ours, tools = pathlib.Path(folder) / "ours.json", pathlib.Path(folder) / "tools.json"
            training.net.save(ours)
            options = "--folds 2 --epochs 5 --restarts 1 --generated 3 --seed 7".split()
            subprocess.run([BIN / "skel-train", few, "-o", tools, *options], check=True, stdout=subprocess.DEVNULL)
            self.assertEqual(ours.read_text(), tools.read_text())
            np.testing.assert_array_equal(skel.Net.load(ours).layers[0][0], training.net.layers[0][0])

    def test_evaluations_count(self) -> None:
        evaluation = skel.evaluate(skel.Net.builtin(), self.characters)
        self.assertEqual(evaluation.confusion.sum(), sum(len(c.labels) for c in self.characters.characters))
        self.assertAlmostEqual(evaluation.accuracy, np.trace(evaluation.confusion) / evaluation.confusion.sum())
        self.assertEqual(len(evaluation.characters), len(self.characters))

    def test_own_arrays_are_learned_from(self) -> None:
        random = np.random.default_rng(1)
        features = random.random((200, 3)).astype(np.float32)
        labels = (2 * (features[:, 2] > 0.5) + (features[:, 1] > 0.5)).astype(int)
        made = skel.LabelledSet([(f"{i}", features[i::4], list(labels[i::4])) for i in range(4)])
        training = skel.train(made, folds=0, epochs=200, generated=0, restarts=1)
        self.assertGreater(skel.evaluate(training.net, made).accuracy, 0.9)
        self.assertIsNone(training.evaluation)
        for bad in [[("a", features * 9, labels)], [("a", features, labels[1:])], [("a", features, labels + 4)], []]:
            with self.assertRaises(skel.UsageError):
                skel.LabelledSet(bad)  # type: ignore[arg-type]
        with self.assertRaises(skel.UsageError):
            skel.train(made, folds=5)

    def test_ctrl_c_ends_training_and_many_drawings(self) -> None:
        train = f"import skel; skel.train(skel.LabelledSet.load({str(DATASETS / 'characters')!r}), epochs=100000, progress=lambda *_: print('at work', flush=True))"
        many = f"import skel, itertools\nfor _ in skel.rig_many(itertools.repeat({str(BOY)!r})): print('at work', flush=True)"
        for program in (train, many):
            with self.subTest(program=program):
                # Jobs in the background of a shell ignore SIGINT, and so would what they start.
                process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                           preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
                assert process.stdout
                self.assertEqual(process.stdout.readline(), "at work\n")
                process.send_signal(signal.SIGINT)
                _, said = process.communicate(timeout=120)
                self.assertIn("KeyboardInterrupt", said)
                self.assertNotEqual(process.returncode, 0)


if __name__ == "__main__":
    unittest.main()
