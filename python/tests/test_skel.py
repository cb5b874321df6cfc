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
from typing import Any, Callable, Iterable, List, Set, Tuple, Type

import numpy as np

import skel

DATASETS = pathlib.Path(os.environ["SKEL_DATASETS"])
BIN = pathlib.Path(os.environ["SKEL_BIN"])
BOY = DATASETS / "characters" / "cap_boy.png"
boy = skel.rig(BOY)
STILL = np.tile([0, 0, 0, 1.0], (2, 1))  # two rotations that turn nothing


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

    def test_a_drawing_is_not_written_over_by_what_is_made_of_it(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            hero, mask, other = (pathlib.Path(folder) / name for name in ("hero.png", "figure.png", "other.png"))
            shutil.copy(BOY, hero)
            shutil.copy(BOY.with_suffix(".mask.png"), other)
            mask.symlink_to(other)
            drawing = skel.rig(hero)
            before = sorted(os.listdir(folder))
            for again in (drawing, drawing.with_joints({"left_hand": (1, 1)})):
                with self.assertRaises(skel.UsageError) as caught:
                    again.save(hero.with_suffix(".obj"))
                self.assertIn("hero.png would be written over", str(caught.exception))
            # Of an array, nobody knows whose drawing it is.
            with self.assertRaises(skel.UsageError) as caught:
                boy.save(hero.with_suffix(".obj"))
            self.assertIn("hero.png would be written over", str(caught.exception))
            masked = skel.rig(hero, mask=mask)
            other.with_suffix(".mtl").write_text("")
            with self.assertRaises(skel.UsageError) as caught:
                masked.save(other.with_suffix(".obj"))
            self.assertIn("figure.png", str(caught.exception))
            other.with_suffix(".mtl").unlink()
            self.assertEqual(sorted(os.listdir(folder)), before)
            self.assertEqual(hero.read_bytes(), BOY.read_bytes())
            self.assertEqual(other.read_bytes(), BOY.with_suffix(".mask.png").read_bytes())
            drawing.save(hero.with_suffix(".glb"))
            for _ in range(2):  # its own texture may be written anew
                drawing.save(pathlib.Path(folder) / "model.obj")

    def test_masks_are_of_bool_or_uint8(self) -> None:
        for mask in (boy.mask / 255, boy.mask.astype(int), -boy.mask.astype(np.int8), np.full(boy.mask.shape, np.nan)):
            with self.subTest(type=mask.dtype), self.assertRaises(skel.UsageError) as caught:
                skel.rig(BOY, mask=mask)
            self.assertIn("bool or uint8", str(caught.exception))

    def test_objects_and_shapes_that_are_wrong_are_named(self) -> None:
        net, many = skel.Net.builtin(), 10**12
        cases: List[Tuple[Callable[[], object], str]] = [
            (lambda: boy.retarget(None), "motion: must be a Clip"),  # type: ignore[arg-type]
            (lambda: boy.pose(3, 0), "clip: must be a Clip"),  # type: ignore[arg-type]
            (lambda: boy.film(None), "clip: must be a Clip"),  # type: ignore[arg-type]
            (lambda: skel.rig("a\0b.png"), "image: holds a character"),
            (lambda: boy.save("a\0b.glb"), "path: holds a character"),
            (lambda: boy.save(3), "path: must be"),  # type: ignore[arg-type]
            (lambda: skel.load(None), "path: must be"),  # type: ignore[arg-type]
            (lambda: skel.LabelledSet.load(3), "folder: must be"),  # type: ignore[arg-type]
            (lambda: skel.rig(BOY, joint_net=3), "joint_net: must be"),  # type: ignore[arg-type]
            (lambda: net.classify(np.zeros((5, 4))), "features: has shape (5, 4), must be (N, 3)"),
            (lambda: net.classify(np.zeros(3)), "features: has shape (3,)"),
            (lambda: net.classify("abc"), "features: must be numbers"),
            (lambda: skel.Pose(np.zeros((3, 3))), "rotations: has shape (3, 3), must be (N, 4)"),
            (lambda: skel.Pose(STILL, (1, 2)), "root_translation: has shape (2,), must be (3,)"),
            (lambda: boy.with_joints({"left_hand": (1, 2, 3)}), 'joints: "left_hand": has shape (3,)'),
            (lambda: boy.with_joints({"left_hand": "ab"}), 'joints: "left_hand": must be numbers'),
            (lambda: boy.with_joints(3), "joints: must be a dict"),  # type: ignore[arg-type]
            (lambda: skel.rig(BOY, figure=many), "figure: must be from 1 to 1000000"),
            (lambda: skel.rig(BOY, into_picture=2), "into_picture: must be from 0 to 1"),
            (lambda: skel.candidates(BOY, figure=many), "figure: must be from 1 to 1000000"),
            (lambda: boy.film("walk", background="#12"), 'background: "#12" is no colour'),
            (lambda: setattr(boy, "clips", 3), "clips: must be a list"),
            (lambda: setattr(boy, "clips", ["walk"]), "clips: must be a list"),
        ]
        for work, words in cases:
            with self.subTest(words=words), self.assertRaises(skel.UsageError) as caught:
                work()
            self.assertIn(words, str(caught.exception))

    def test_characters_say_what_they_are(self) -> None:
        self.assertRegex(repr(boy), r"<skel.Drawing: biped, \d+ joints, \d+ vertices>")
        self.assertRegex(repr(boy.mesh), r"<skel.Mesh: \d+ vertices, \d+ triangles>")


class TestMoving(unittest.TestCase):
    def test_a_character_comes_back_from_its_file(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "boy.glb"
            boy.save(path)
            back = skel.load(path)
            back.save(path)
        np.testing.assert_allclose(back.mesh.vertices.mean(axis=0), boy.mesh.vertices.mean(axis=0), atol=0.05)
        self.assertEqual([clip.name for clip in back.clips], [clip.name for clip in boy.clips])

    def test_joints_of_a_file_have_no_drawing(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            boy.save(pathlib.Path(folder) / "boy.glb")
            back = skel.load(pathlib.Path(folder) / "boy.glb")
        for joint, drawn in zip(back.joints, boy.joints):
            self.assertTrue(np.isnan(joint.image).all() and np.isnan(joint.confidence))
            self.assertIsNone(joint.origin)
            np.testing.assert_allclose(joint.position, drawn.position, atol=1e-4)

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
        for bad in ([1, 0], [0, 0]):
            with self.assertRaises(skel.UsageError) as caught:
                skel.Clip("back", {"head": (bad, STILL)})
            self.assertIn("must ascend", str(caught.exception))

    def test_clips_of_other_counts_are_refused(self) -> None:
        cases: List[Tuple[Any, str]] = [
            (([0, 1, 2], STILL), "has 3 times, but 2 rotations"),
            (([0], STILL), "has 1 times, but 2 rotations"),
            (([], STILL[:0]), "has no keys"),
            (([0, float("nan")], STILL), "times: must be finite"),
            (([-1, 0], STILL), "times: must be finite, from 0"),
            (([0, 1e9], STILL), "times: must be finite, from 0 to 3600 s"),
            (([0, 1], STILL[:, :3]), "has shape (2, 3), must be (N, 4)"),
            (([[0, 1]], STILL), "times: has shape (1, 2)"),
            ((["a", "b"], STILL), "times: must be numbers"),
            (3, "must be a pair"),
        ]
        for keys, words in cases:
            with self.subTest(words=words), self.assertRaises(skel.UsageError) as caught:
                skel.Clip("c", {"left_hand": keys})
            self.assertIn(words, str(caught.exception))
            self.assertIn('joint "left_hand"', str(caught.exception))
        with self.assertRaises(skel.UsageError):
            skel.Clip("c", {}, root=([0, 1], [[0, 0, 0]]))

    def test_clips_with_joints_that_are_not_there_are_refused(self) -> None:
        drawing = skel.rig(BOY, clips=False)
        bad = skel.Clip("c", {"tentacle": ([0, 1], STILL)})
        works: List[Callable[[], object]] = [
            lambda: setattr(drawing, "clips", [bad]), lambda: drawing.pose(bad, 0), lambda: drawing.film(bad)
        ]
        for work in works:
            with self.assertRaises(skel.UsageError) as caught:
                work()
            self.assertIn("tentacle", str(caught.exception))
        self.assertEqual(drawing.clips, [])
        drawing.to_glb()

    def test_clips_that_are_not_of_the_character_are_refused(self) -> None:
        builtin = next(c for c in skel.builtin_clips() if c.name == "walk" and c.body_plan == "biped")
        beast = skel.Clip("c", {"head": ([0, 1], STILL)}, "quadruped")
        for clip, words in [(builtin, "retarget()"), (beast, "quadruped")]:
            works: List[Callable[[], object]] = [
                lambda: boy.pose(clip, 0), lambda: boy.film(clip), lambda: setattr(boy, "clips", [clip])
            ]
            for work in works:
                with self.subTest(words=words), self.assertRaises(skel.UsageError) as caught:
                    work()
                self.assertIn(words, str(caught.exception))
        boy.pose(boy.retarget(builtin), 0)

    def test_a_clip_is_made_anew_with_its_root(self) -> None:
        for clip in boy.clips:
            again = skel.Clip(clip.name, clip.tracks, clip.body_plan, clip.root)
            for time_s in (0, clip.duration_s / 3, clip.duration_s):
                there, here = boy.pose(clip, time_s), boy.pose(again, time_s)
                np.testing.assert_allclose(here.root_translation, there.root_translation, atol=1e-6)
                np.testing.assert_allclose(boy.joint_positions(here), boy.joint_positions(there), atol=1e-5)
        self.assertIsNotNone(boy.clip("jump").root)

    def test_clips_are_set_while_others_use_the_character(self) -> None:
        drawing = skel.rig(BOY)
        all_clips = drawing.clips
        kept = drawing.clips[0]
        end = time.monotonic() + 3
        failures: List[BaseException] = []

        def until_the_end(work: Callable[[], object]) -> None:
            try:
                while time.monotonic() < end:
                    work()
            except BaseException as failure:
                failures.append(failure)

        def set_them() -> None:
            drawing.clips = all_clips[:1]
            drawing.clips = all_clips

        name = all_clips[0].name
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "boy.glb"
            works: List[Callable[[], object]] = [
                set_them,
                lambda: [clip.tracks for clip in drawing.clips],
                lambda: drawing.pose(name, 0.3),
                lambda: drawing.film(name, size=(16, 16))[0],
                lambda: drawing.retarget(name),
                drawing.to_glb,
                lambda: drawing.save(path),
            ]
            threads = [threading.Thread(target=until_the_end, args=(work,)) for work in works]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(failures, [])
        drawing.clips = []
        self.assertEqual(kept.name, name)

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
            self.assertEqual(drawing.to_glb(), skel.rig(path).to_glb())

    def test_errors_are_raised_or_returned(self) -> None:
        paths = [str(BOY), "no.png", str(BOY)]
        kinds = [type(result) for result in skel.rig_many(paths, errors="return", clips=False)]
        self.assertEqual(kinds, [skel.Drawing, skel.InputError, skel.Drawing])
        with self.assertRaises(skel.InputError):
            list(skel.rig_many(paths, clips=False))

    def test_threads_may_be_the_first_to_need_numpy(self) -> None:
        program = f"import skel; print(len(list(skel.rig_many([{str(BOY)!r}] * 4, jobs=4))))"
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stdout, "4\n", done.stderr)

    def test_one_path_is_not_many(self) -> None:
        for one in ("hero.png", BOY):
            with self.assertRaises(skel.UsageError) as caught:
                skel.rig_many(one)  # type: ignore[call-overload]
            self.assertIn("list of paths", str(caught.exception))

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
    def test_types_are_as_wide_as_what_runs(self) -> None:
        # mypy reads this, too.
        characters = skel.LabelledSet.load(DATASETS / "characters").characters[:2]
        again = skel.LabelledSet([(c.name, c.features, c.labels) for c in characters])
        self.assertEqual(len(again), 2)
        self.assertEqual(len(skel.LabelledSet([("a", [[0.1, 0.2, 0.3]], [1])])), 1)
        clip = skel.Clip("nod", {"head": (np.linspace(0, 1, 2), STILL)})
        self.assertEqual(clip.duration_s, 1)
        self.assertRegex(skel.__version__, r"^\d+\.\d+\.\d+$")
        confidences = [drawing.confidence for drawing in skel.rig_many([BOY], clips=False)]
        self.assertEqual(confidences, [boy.confidence])

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
        self.assertRegex(repr(evaluation), r"<skel.Evaluation: accuracy 0\.\d+, \d+ characters>")

    def test_own_arrays_are_learned_from(self) -> None:
        random = np.random.default_rng(1)
        features = random.random((200, 3)).astype(np.float32)
        labels = (2 * (features[:, 2] > 0.5) + (features[:, 1] > 0.5)).astype(int)
        made = skel.LabelledSet([(f"{i}", features[i::4], list(labels[i::4])) for i in range(4)])
        training = skel.train(made, folds=0, epochs=200, generated=0, restarts=1)
        self.assertGreater(skel.evaluate(training.net, made).accuracy, 0.9)
        self.assertIsNone(training.evaluation)
        self.assertRegex(repr(training), r"<skel.Training: \d+ epochs, loss 0\.\d+>")
        for bad in [[("a", features * 9, labels)], [("a", features, labels[1:])], [("a", features, labels + 4)], []]:
            with self.assertRaises(skel.UsageError):
                skel.LabelledSet(bad)  # type: ignore[arg-type]
        for wrong, words in [("abc", "characters: must be a list"), ([("a", features[:, :2], labels)], "has shape (200, 2)"),
                             ([("a", features, labels + 0.5)], "labels must be 0 to 3"), (["abc"], "characters: must be a list")]:
            with self.assertRaises(skel.UsageError) as caught:
                skel.LabelledSet(wrong)  # type: ignore[arg-type]
            self.assertIn(words, str(caught.exception))
        with self.assertRaises(skel.UsageError):
            skel.train(made, folds=5)
        with self.assertRaises(skel.UsageError) as caught:
            skel.train(made, seed=2**40)
        self.assertIn("seed: must be from 0 to 2000000000", str(caught.exception))

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

    def test_ctrl_c_ends_training_while_figures_are_drawn(self) -> None:
        program = f"import skel; s = skel.LabelledSet.load({str(DATASETS / 'characters')!r}); print('at work', flush=True); skel.train(s, folds=0, generated=100000)"
        process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        assert process.stdout
        self.assertEqual(process.stdout.readline(), "at work\n")
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=30)  # of many minutes
        self.assertIn("KeyboardInterrupt", said)


if __name__ == "__main__":
    unittest.main()
