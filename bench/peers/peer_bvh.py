"""three-mesh-bvh, in a process of node that times itself."""

import json
import os
import subprocess
import tempfile

import numpy as np

from asked import Timed, pairs_of

NODE, FOLDER = ["node", "--no-deprecation", os.path.splitext(os.path.abspath(__file__))[0] + ".cjs"], tempfile.TemporaryDirectory()
try:
    NAME = subprocess.check_output(NODE, text=True, stderr=subprocess.DEVNULL)
except (OSError, subprocess.CalledProcessError):
    raise ImportError("node does not find it") from None


def path(name):
    return os.path.join(FOLDER.name, name)


def ways(task, question):
    for name, array in (("vertices", task.vertices), ("faces", task.faces), ("boxes", np.concatenate([task.los, task.his], 1))):
        array.tofile(path(name))
    return (lambda: Timed(*json.loads(subprocess.check_output([*NODE, FOLDER.name]))[question]),
            lambda _: pairs_of(*(np.fromfile(path(name), np.uint32) for name in ("numbers", "start"))))


WAYS = {"index": ("MeshBVH", lambda task: ways(task, 0)), "boxes": ("shapecast", lambda task: ways(task, 1))}
