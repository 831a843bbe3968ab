"""Which files and folders of a tree belong to the project: neither hidden, nor built, nor fetched."""

import os
import pathlib

_NOT_OURS = {"build", "node_modules", "__pycache__"}


def _ours(folder):
    return not (folder.startswith((".", "build-")) or folder in _NOT_OURS)


def folders(root):
    """(path relative to `root` with slashes, names of its files), the root as ".", sorted."""
    found = []
    for path, inside, files in os.walk(root):
        inside[:] = sorted(folder for folder in inside if _ours(folder))
        relative = pathlib.Path(path).relative_to(root).as_posix()
        found.append((relative, sorted(name for name in files if not name.startswith("."))))
    return found


def files(root, *suffixes):
    """Paths relative to `root` of files with one of the suffixes."""
    return [name if folder == "." else f"{folder}/{name}"
            for folder, names in folders(root) for name in names if name.endswith(suffixes)]


def read(root, path):
    return (pathlib.Path(root) / path).read_text(encoding="utf-8", errors="replace")
