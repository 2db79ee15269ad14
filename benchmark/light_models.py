#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen of baked light models, by faces and texture, without and with the signal of the normals.

A CSV file on stdout; angles in degrees, as `hlscm bake` reports them. With a texture of 4096 texels a side
what is left of them is that of the light model's own shape, which no map can help.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile


def bake(program, model, faces, size, options):
    """The report of a light model."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        subprocess.run([program, "bake", model, "-o", folder, "--faces", str(faces), "--texture", str(size),
                        "--report", report, "--threads", "1", "--quiet", *options], check=True)
        return json.loads(report.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="hlscm")
    parser.add_argument("models", nargs="+")
    parser.add_argument("--faces", nargs="+", type=int, default=[1000, 4000])
    parser.add_argument("--sizes", nargs="+", type=int, default=[128, 256, 512, 1024, 4096])
    parser.add_argument("--signals", nargs="+", choices=["none", "normals"], default=["none", "normals"])
    arguments = parser.parse_args()
    print("model,faces,light_faces,size,signal,charts,used,mean_angle,angle_95")
    for model in arguments.models:
        for faces in arguments.faces:
            for size in arguments.sizes:
                for signal in arguments.signals:
                    options = [] if signal == "none" else ["--signal", signal]
                    report = bake(arguments.program, model, faces, size, options)
                    error = report["light"]["normal_error_degrees"]["with_map"]
                    print(f"{pathlib.Path(model).stem},{report['faces']},{report['light']['faces']},{size},"
                          f"{signal},{report['number_of_charts']},{report['utilisation']:.3f},"
                          f"{error['mean']:.4f},{error['quantile_95']:.4f}", flush=True)


if __name__ == "__main__":
    main()
