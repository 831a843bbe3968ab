"""The rules. Each takes the root of a tree and returns its faults as lines for a person."""

import re

import layers
import source
import tree

MOST_LINES_OF_A_FUNCTION = 60
MOST_LINES_OF_A_FILE = 500

CPP = (".cc", ".h")
TEXT = (".cc", ".h", ".py", ".sh", ".proto", ".sql", ".ts", ".cmake", "CMakeLists.txt")
# Folders at the root that hold this project's own headers.
OWN = (
    "compensation/", "core/", "formats/", "programs/", "convert/", "server/", "client/", "bench/", "tests/")


# The root's options and the generated messages.
_LINK_NOTHING_OF_OURS = ("", "proto")


def include_direction(root):
    """No include upwards or sideways, and no file outside of the table of layers."""
    faults = []
    for path in tree.files(root, *CPP):
        folder = path.rpartition("/")[0]
        row = layers.row_of(folder)
        if row is None:
            faults.append(f"{path}: its folder has no row in tests/architecture/layers.py")
            continue
        for line, include in source.includes(tree.read(root, path)):
            used = _used_by_include(include)
            if used is not None and not layers.may_use(row, used):
                faults.append(f"{path}:{line}: {row} must not include {include} ({used})")
    return faults


def _used_by_include(include):
    if include.startswith(OWN):
        return include.rpartition("/")[0]
    return layers.external_header(include)


def link_direction(links):
    """The same rule for link lists. `links` has lines "target|folder|item;item"; folders are relative to the root."""
    rows = [line.split("|") for line in links.splitlines() if line.strip()]
    folder_of = {target: folder for target, folder, _ in rows}
    faults = [] if rows else ["the graph of links is empty"]
    for target, folder, items in rows:
        row = layers.row_of(folder)
        if row is None and folder not in _LINK_NOTHING_OF_OURS:
            faults.append(f"{target} in {folder}: its folder has no row in tests/architecture/layers.py")
        for item in sorted(set(filter(None, items.split(";")))):
            used = _used_by_link(item, folder_of)
            if row is not None and used is not None and not layers.may_use(row, used):
                faults.append(f"{target} in {folder} must not link {item} ({used})")
    return faults


def _used_by_link(item, folder_of):
    folder = folder_of.get(item, "")
    return folder if folder.startswith(OWN) or folder + "/" in OWN else layers.external_target(item)


def function_length(root):
    """No function over 60 lines."""
    return [f"{path}:{function.line}: {function.name} has {function.lines} lines, at most {MOST_LINES_OF_A_FUNCTION}"
            for path in tree.files(root, *CPP) for function in source.functions(tree.read(root, path))
            if function.lines > MOST_LINES_OF_A_FUNCTION]


def file_length(root):
    """No file over 500 lines."""
    faults = []
    for path in tree.files(root, *TEXT):
        lines = len(tree.read(root, path).splitlines())
        if lines > MOST_LINES_OF_A_FILE:
            faults.append(f"{path}: {lines} lines, at most {MOST_LINES_OF_A_FILE}")
    return faults


def readme_in_every_folder(root):
    """A folder that holds files says what it is and why it is split so, in at most a page."""
    faults = []
    for folder, names in tree.folders(root):
        if names and "README.md" not in names:
            faults.append(f"{folder}: no README.md")
    return faults


def every_test_is_built(root):
    """Each *_test.cc stands in a CMakeLists.txt that is reached from tests/CMakeLists.txt."""
    built, queue = set(), ["tests"]
    while queue:
        folder = queue.pop()
        words = _cmake_words(root, f"{folder}/CMakeLists.txt")
        built.update(f"{folder}/{word}" for word in words if word.endswith(".cc"))
        queue.extend(f"{folder}/{word}" for word in _subdirectories(root, f"{folder}/CMakeLists.txt"))
    return [f"{path}: no CMakeLists.txt reached from tests/CMakeLists.txt builds it"
            for path in tree.files(root, "_test.cc") if path not in built]


def _cmake_text(root, path):
    return re.sub(r'#[^\n]*', '', tree.read(root, path)) if path in tree.files(root, "CMakeLists.txt") else ""


def _cmake_words(root, path):
    return re.findall(r'[^\s()"]+', _cmake_text(root, path))


def _subdirectories(root, path):
    return re.findall(r'add_subdirectory\(\s*([^\s)]+)', _cmake_text(root, path))


def no_skipped_test(root):
    """No test that is skipped or disabled."""
    skipped = re.compile(r'\b(GTEST_SKIP|DISABLED_\w*)\b')
    return [f"{path}: {match.group()}" for path in tree.files(root, *CPP)
            for match in skipped.finditer(source.blank(tree.read(root, path)))]


OF_A_TREE = (include_direction, function_length, file_length, readme_in_every_folder, every_test_is_built,
             no_skipped_test)


def function_sizes(root):
    """Lengths of all functions outside of tests, ascending."""
    return sorted(function.lines for path in tree.files(root, *CPP) if not path.startswith("tests/")
                  for function in source.functions(tree.read(root, path)))
