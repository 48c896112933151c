"""What pip and build call (PEP 517): setuptools, in a copy of the package's files, so that it writes nothing beside the sources."""

import os
import shutil
import sys
import tempfile
from contextlib import contextmanager

from setuptools import build_meta

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "python"))

from making.library import files  # noqa: E402


@contextmanager
def in_a_copy():
    """The current folder, until the end, is a copy of the package's files."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory(prefix="tribox-") as copy:
        for file in files(ROOT):
            os.makedirs(os.path.dirname(os.path.join(copy, file)), exist_ok=True)
            shutil.copy2(os.path.join(ROOT, file), os.path.join(copy, file))
        os.chdir(copy)
        try:
            yield
        finally:
            os.chdir(before)


def get_requires_for_build_wheel(config_settings=None):
    return []


get_requires_for_build_sdist = get_requires_for_build_wheel


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = os.path.abspath(metadata_directory)
    with in_a_copy():
        return build_meta.prepare_metadata_for_build_wheel(folder, config_settings)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = os.path.abspath(wheel_directory)
    metadata = metadata_directory and os.path.abspath(metadata_directory)
    with in_a_copy():
        return build_meta.build_wheel(folder, config_settings, metadata)


def build_sdist(sdist_directory, config_settings=None):
    folder = os.path.abspath(sdist_directory)
    with in_a_copy():
        return build_meta.build_sdist(folder, config_settings)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    raise SystemExit("tribox has no editable installation, as the library is built into the package; build it with meson, and set "
                     "PYTHONPATH=build/python TRIBOX_LIBRARY=build/src/libtribox.so.1")
