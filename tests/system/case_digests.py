"""A digest of the in-house engine's bits for every case that is shipped, kept in case_digests.json.

Each case is run for a short time (its first variant; of a cell packing 0) and all arrays that the engine answers, positions, velocities, spins,
walls and contacts of ten looks, go into one digest. It covers scene, packing and engine, on a processor held to instructions that every x86-64
machine has (golden/golden.py); grain's own AVX2 and AVX-512 must give the same, and so does a build by another compiler (tests/README.md).
Left out, each with the reason, is what LEFT_OUT says.

What changes bits on purpose says so in changes/ and renews the file:
    CROSSGRAIN=build/release/cli/crossgrain python3 case_digests.py   (in this folder)
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import harness

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "golden"))
from golden import BASELINE, ROOT  # noqa: E402

KEPT = pathlib.Path(__file__).resolve().parent / "case_digests.json"
CASES = ROOT / "cases"
FOLDERS = ("assembly", "collision", "couette", "hard")
LEFT_OUT = {
    "couette/nu-0.804": "its packing takes minutes",
    "couette/nu-0.804-slow": "its packing takes minutes",
    "couette/nu-0.804-spacing-7mm": "its packing takes minutes",
    "hard/blocked": "a packing of its own",
    "hard/couette-rates": "a packing of its own",
    "hard/long-couette": "a packing of its own",
    "hard/coincident-centres": "is refused, as it must be",
    "hard/disk-in-disk": "is refused, as it must be",
}
LEFT_OUT |= {f"{folder}/{file.stem}": "grain has no convex bodies" for folder in ("collision", "hard") for file in CASES.glob(f"{folder}/convex-*.toml")}
SECONDS = 0.02  # some 500 steps of most; collisions take as long as they take
OWN_SECONDS = {"hard/units": 5e-7, "couette/quick": 0.005}


def shipped():
    """Names of all cases that have a digest."""
    files = [file for folder in FOLDERS for file in sorted((CASES / folder).glob("*.toml"))]
    names = [str(file.relative_to(CASES).with_suffix("")) for file in files]
    return [name for name in names if name not in LEFT_OUT]


def digest(name, cache, *arguments, **environment):
    """Of one case, with the command line's changes."""
    seconds = OWN_SECONDS.get(name, SECONDS)
    time = [] if name.startswith("collision/") else ["--time", str(seconds)]
    with tempfile.TemporaryDirectory(prefix="crossgrain-bits-") as folder:
        recording = pathlib.Path(folder) / "run.rec"
        done = subprocess.run(
            [os.environ["CROSSGRAIN"], "record", f"cases/{name}.toml", "--engines", "grain", *time, *arguments,
             "--out", recording],
            cwd=ROOT, env=os.environ | BASELINE | {"CROSSGRAIN_CACHE": str(cache)} | environment,
            capture_output=True, encoding="utf-8", check=False,
        )  # fmt: skip
        if done.returncode != 0:
            raise AssertionError(f"{name}: status {done.returncode}\n{done.stderr}")
        content = hashlib.sha256()
        size = 0
        for _, _, data in harness.recorded_exchanges(recording):
            content.update(data)
            size += len(data)
        assert size > 0, name
        return content.hexdigest()[:16]


def main():
    with tempfile.TemporaryDirectory(prefix="crossgrain-bits-") as cache:
        found = {name: digest(name, cache) for name in shipped()}
    KEPT.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(f"{len(found)} cases", file=sys.stderr)


if __name__ == "__main__":
    main()
