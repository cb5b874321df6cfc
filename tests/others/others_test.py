"""The annotations of the repository pass script/others-drawings --check; what is measured on elsewhere is refused."""
import json, pathlib, subprocess, sys, tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OTHERS = ROOT / "datasets" / "others"
EXCLUDED = json.loads((OTHERS / "excluded.json").read_text())


def complaint(folder):
    run = subprocess.run([sys.executable, ROOT / "script" / "others-drawings", "--check", "--annotations", folder], capture_output=True, text=True)
    assert (run.returncode == 0) == (run.stderr == ""), run
    return run.stderr


def complaint_about(*changes):
    """Of a drawing that may be learned from, once for each of the changes."""
    good = json.loads(sorted(OTHERS.glob("people/*.json"))[0].read_text()) | {"set": "learn"}
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "excluded.json").write_text(json.dumps(EXCLUDED))
        (pathlib.Path(folder) / "people").mkdir()
        for number, change in enumerate(changes):
            (pathlib.Path(folder) / "people" / f"{number}.json").write_text(json.dumps(good | change))
        return complaint(folder)


assert complaint(OTHERS) == ""
assert complaint_about({}) == ""
# A file of every version is read for ever.
SAMPLES = sorted((ROOT / "tests" / "data" / "formats").glob("skel-others-drawing-*.json"))
assert SAMPLES
for sample in SAMPLES:
    assert complaint_about(json.loads(sample.read_text()) | {"set": "learn"}) == "", sample
assert "this drawing is measured on elsewhere" in complaint_about({"sha256": EXCLUDED["files"][0]})
assert f"drawings by {EXCLUDED['artists'][0]} are measured on elsewhere" in complaint_about({"artist": EXCLUDED["artists"][0]})
assert "may be learned from, but not be measured on" in complaint_about({"artist": EXCLUDED["shared_artists"][0], "set": "measure"})
assert "drawings by nobody known" in complaint_about({"artist": "", "set": "measure"})
assert "A is learned from and measured on" in complaint_about({"artist": "A"}, {"artist": "A", "set": "measure"})
assert "is none of skel-others-drawing" in complaint_about({"version": 2})
assert "is none of skel-others-drawing" in complaint_about({"another": 1})
