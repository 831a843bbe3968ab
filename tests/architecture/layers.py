"""Layers of the tree: a folder may include and link only what its row names.

The longest matching folder counts. A folder always may use itself and what lies below it in the same row.
Words without a slash are libraries from outside (see EXTERNAL_HEADERS); outside libraries not named there are free.
"""

_CORE_ORDER = (
    ("core/base",),
    ("core/geometry",),
    ("core/chain",),
    ("core/robot",),
    ("core/parameters",),
    ("core/models", "core/measurement"),
    ("core/identification", "core/compensation", "core/export"),
    ("core/assessment", "core/planning", "core/conversion"),  # docs/decisions/0004
    ("core/calibrate", "core/drift", "core/simulation"),
    ("core/reproduce",),
)


def _core_rows():
    rows, below = {}, ()
    for level in _CORE_ORDER:
        for folder in level:
            rows[folder] = below
        below += level
    return rows


# Folder -> what it may use besides itself.
ALLOWED = {
    **_core_rows(),
    "core/compensation": (*_core_rows()["core/compensation"], "compensation"),
    "compensation": ("core/geometry", "io"),  # of which the header-only part alone: it links Eigen only; maps its file
    "formats": ("core/base", "proto", "yaml", "json", "urdf", "io"),
    "programs": ("core/base", "formats"),
    "convert": ("core", "compensation", "proto", "openssl", "io"),
    # Messages alone: what the agent has of it.
    "convert/rules": ("core/base", "proto"),
    "server/store": ("core/base", "proto", "sqlite", "openssl", "io"),
    "server/jobs": ("core/base", "convert", "server/store", "proto", "io", "spdlog"),
    "server/auth": ("core/base", "server/store", "proto", "io"),
    "server/resource": ("core/base", "convert", "server/store", "proto", "io"),
    "server/watch": ("core/base", "server/store", "proto", "io"),
    "server/rpc": ("core/base", "proto", "grpc", "io", "spdlog"),
    "server/services": (
        "core/base", "convert", "server/store", "server/auth", "server/jobs", "server/resource", "server/watch",
        "server/rpc", "proto", "grpc", "io", "spdlog"),
    "server": (
        "core", "compensation", "convert", "formats", "proto", "grpc", "io", "spdlog", "cli11", "sqlite", "openssl"),
    "client/cli": (
        "core", "compensation", "formats", "programs", "convert", "client", "proto", "grpc", "io", "cli11", "json",
        "openssl"),
    "client/agent": ("core/base", "convert/rules", "compensation", "client", "proto", "io", "cli11", "json", "spdlog", "toml"),
    # core/geometry: the header-only part alone.
    "client/agent/released": ("core/base", "core/geometry", "compensation", "client", "client/agent", "proto", "io", "json"),
    "client/agent/sources": ("core/base", "formats", "client/agent", "proto", "io", "json"),
    # No part of the agent itself: a robot that is made up.
    "client/agent/simulated": ("core", "convert", "formats", "client/agent", "proto", "io", "cli11"),
    "client": ("core/base", "proto", "grpc", "io", "openssl"),
    "tests": (
        "core", "compensation", "formats", "programs", "convert", "server", "client", "bench", "proto", "grpc", "sqlite",
        "yaml", "json", "urdf", "openssl", "spdlog", "cli11", "io"),
    "bench": (
        "core", "compensation", "formats", "programs", "convert", "server", "client", "tests", "proto", "grpc", "json", "io",
        "sqlite"),
}

# Folders whose row does not reach into these folders below them, which have rows of their own.
NOT_BELOW = {"client": ("client/cli", "client/agent"), "client/agent": ("client/cli", "client/agent/simulated"), "client/cli": ("client/agent",)}

# Library word -> how its headers begin, as they stand in an #include.
EXTERNAL_HEADERS = {
    "grpc": ("grpc/", "grpcpp/", "grpc++/"),
    "proto": ("google/protobuf/", "google/rpc/", "truepose/v1/"),
    "sqlite": ("sqlite3",),
    "yaml": ("yaml-cpp/",),
    "json": ("nlohmann/",),
    "urdf": ("urdf_", "console_bridge/"),
    "openssl": ("openssl/",),
    "spdlog": ("spdlog/",),
    "cli11": ("CLI/",),
    "toml": ("toml++/",),
    # The core has no files, clock, threads or environment.
    "io": ("fstream", "iostream", "filesystem", "thread", "chrono", "ctime", "cstdio", "unistd.h", "sys/"),
}

# Library word -> how its CMake targets or libraries are called, in lower case.
EXTERNAL_TARGETS = {
    "grpc": ("grpc", "truepose_proto_grpc"),
    "proto": ("protobuf", "truepose_proto"),
    "sqlite": ("sqlite",),
    "yaml": ("yaml-cpp",),
    "json": ("nlohmann",),
    "urdf": ("urdfdom", "console_bridge"),
    "openssl": ("openssl",),
    "spdlog": ("spdlog",),
    "cli11": ("cli11",),
    "toml": ("tomlplusplus",),
}


def within(path, folder):
    return path == folder or path.startswith(folder + "/")


def row_of(path):
    """The folder of ALLOWED that `path` belongs to, or None."""
    rows = [folder for folder in ALLOWED if within(path, folder)]
    return max(rows, key=len, default=None)


def may_use(row, used):
    """Whether a file in folder `row` may use `used`, a path in the tree or a library word."""
    if any(within(used, folder) for folder in NOT_BELOW.get(row, ())):
        return False
    return any(within(used, folder) for folder in (row, *ALLOWED[row]))


def external_header(include):
    """The library word of an included header, or None when it is free for all."""
    if include.endswith(".grpc.pb.h"):
        return "grpc"
    for word, prefixes in EXTERNAL_HEADERS.items():
        if include.startswith(prefixes):
            return word
    return None


def external_target(target):
    """The library word of a link item such as gRPC::grpc++, or None."""
    name = target.lower()
    for word, parts in EXTERNAL_TARGETS.items():
        if any(part in name for part in parts):
            return word
    return None
