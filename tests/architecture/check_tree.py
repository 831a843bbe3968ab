#!/usr/bin/env python3
"""check_tree.py ROOT [--rule NAME | --links FILE]: prints every fault of the tree and ends with 1 when there is one."""

import argparse
import pathlib
import sys

import checks


def print_sizes(root):
    sizes = checks.function_sizes(root)
    if sizes:
        print(f"functions: {len(sizes)}, median {sizes[len(sizes) // 2]} lines, "
              f"95th percentile {sizes[int(0.95 * (len(sizes) - 1))]}, longest {sizes[-1]}")


def faults_of(arguments):
    if arguments.links:
        return checks.link_direction(pathlib.Path(arguments.links).read_text(encoding="utf-8"))
    rules = [rule for rule in checks.OF_A_TREE if arguments.rule in (None, rule.__name__)]
    if not rules:
        return [f"--rule: found {arguments.rule}, expected one of "
                + ", ".join(rule.__name__ for rule in checks.OF_A_TREE)]
    return [f"{rule.__name__}: {fault}" for rule in rules for fault in rule(arguments.root)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root")
    parser.add_argument("--rule")
    parser.add_argument("--links", help="file that LinkGraph.cmake has written")
    arguments = parser.parse_args()
    faults = faults_of(arguments)
    print("\n".join(faults) if faults else "no faults")
    if arguments.rule in (None, "function_length") and not arguments.links:
        print_sizes(arguments.root)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
