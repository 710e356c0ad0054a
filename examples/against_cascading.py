#!/usr/bin/env python3
"""Hausdorff distances of `subcert measure` against those of the package `cascading_upper_bounds`.

That package (pip install cascading_upper_bounds) bounds the one-sided distance between two triangle
meshes. It knows no limit surface, so the limit mesh of level K stands in for it, and the certified
distance between the surface and that mesh corrects its bounds outward:

    |h(S, M) - h(S_K, M)| <= H(S, S_K)   and   |h(M, S) - h(M, S_K)| <= H(S, S_K).

For each mesh and side the corrected enclosure must meet the certified one.

    python3 examples/against_cascading.py target/release/subcert MESH.obj ... [--level 4]

Loop surfaces of triangle meshes; exit code 1 if an enclosure does not meet, 2 if the package is missing.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import cascading_upper_bounds as cascading
    import numpy as np
except ImportError:
    sys.exit("pip install cascading_upper_bounds numpy")


def load(path):
    vertices, faces = [], []
    for line in Path(path).read_text().splitlines():
        fields = line.split()
        if fields[:1] == ["v"]:
            vertices.append([float(x) for x in fields[1:4]])
        elif fields[:1] == ["f"]:
            faces.append([int(x) - 1 for x in fields[1:4]])
    return np.array(vertices), np.array(faces, dtype=np.int32)


def certified(program, mesh, *options):
    command = [program, "measure", mesh, "--scheme", "loop", "--json", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--level", type=int, default=4)
    arguments = parser.parse_args()
    apart = 0
    print(f"{'mesh':24} {'side':16} {'subcert lo':>12} {'subcert hi':>12} {'theirs, corrected':>27} {'remaining':>10} {'seconds':>8}")
    for mesh in arguments.meshes:
        with tempfile.TemporaryDirectory() as folder:
            fine = str(Path(folder) / "limit.obj")
            refine = [arguments.program, "refine", mesh, "--scheme", "loop"]
            subprocess.run([*refine, "--levels", str(arguments.level), "--limit", "-o", fine], check=True, capture_output=True)
            surface, control = load(fine), load(mesh)
        level = ["--level", str(arguments.level), "--against", "limit"]
        remaining = certified(arguments.program, mesh, "--distance", "hausdorff", *level)["hi"]
        diagonal = float(np.linalg.norm(np.ptp(control[0], axis=0)))
        for side, first, second in [("surface-to-mesh", surface, control), ("mesh-to-surface", control, surface)]:
            ours = certified(arguments.program, mesh, "--distance", side)
            start = time.perf_counter()
            lower, upper = cascading.pompeiu_hausdorff(*first, *second, 1e-6 * diagonal, 10**6, False)[:2]
            seconds = time.perf_counter() - start
            low, high = lower - remaining, upper + remaining
            meet = low <= ours["hi"] and ours["lo"] <= high
            apart += not meet
            print(f"{Path(mesh).stem:24} {side:16} {ours['lo']:12.8f} {ours['hi']:12.8f}  [{low:12.8f}, {high:11.8f}] {remaining:10.2e} {seconds:8.2f}{'' if meet else '  APART'}")
    sys.exit(1 if apart else 0)


if __name__ == "__main__":
    main()
