#!/usr/bin/env python3
"""Each rule is given a tree that breaks it and one that keeps it. A rule that lets its bad sample pass fails here."""

import pathlib
import tempfile
import unittest

import checks
import source


def long_function(lines):
    return "int F(int a) {\n" + "  a += 1;\n" * (lines - 2) + "}\n"


class TreeCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name

    def write(self, path, text=""):
        file = pathlib.Path(self.root) / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


class IncludeDirection(TreeCase):
    def faults(self, path, include):
        self.write(path, f"#include {include}\n")
        return checks.include_direction(self.root)

    def bites(self, path, include):
        self.assertEqual(len(self.faults(path, include)), 1, f"{path} with {include} passed")

    def passes(self, path, include):
        self.assertEqual(self.faults(path, include), [])

    def test_core_including_upwards_inside_core(self):
        self.bites("core/chain/chain.h", '"core/robot/robot.h"')

    def test_core_including_sideways(self):
        self.bites("core/models/a.h", '"core/measurement/b.h"')

    def test_identification_including_what_judges_it(self):
        self.bites("core/identification/identify.cc", '"core/assessment/verdict.h"')

    def test_core_including_downwards_passes(self):
        self.passes("core/robot/robot.h", '"core/chain/chain.h"')

    def test_core_including_proto(self):
        self.bites("core/robot/robot.cc", '"truepose/v1/robot.pb.h"')

    def test_core_including_grpc(self):
        self.bites("core/robot/robot.cc", "<grpcpp/grpcpp.h>")

    def test_core_including_sqlite(self):
        self.bites("core/robot/robot.cc", "<sqlite3.h>")

    def test_core_reading_files(self):
        self.bites("core/robot/robot.cc", "<fstream>")

    def test_core_including_convert(self):
        self.bites("core/calibrate/calibrate.cc", '"convert/run.h"')

    def test_formats_including_core_beyond_base(self):
        self.bites("formats/csv.cc", '"core/robot/robot.h"')

    def test_formats_including_core_base_passes(self):
        self.passes("formats/csv.cc", '"core/base/fault.h"')

    def test_convert_including_formats(self):
        self.bites("convert/run.cc", '"formats/csv.h"')

    def test_store_including_core(self):
        self.bites("server/store/jobs.cc", '"core/calibrate/calibrate.h"')

    def test_store_including_grpc_services(self):
        self.bites("server/store/jobs.cc", '"truepose/v1/services.grpc.pb.h"')

    def test_jobs_including_services(self):
        self.bites("server/jobs/engine.cc", '"server/services/job_service.h"')

    def test_client_library_including_server(self):
        self.bites("client/client.cc", '"server/store/store.h"')

    def test_client_library_including_core(self):
        self.bites("client/client.cc", '"core/calibrate/calibrate.h"')

    def test_client_library_including_the_command_line(self):
        self.bites("client/client.cc", '"client/cli/report.h"')

    def test_command_line_including_server(self):
        self.bites("client/cli/serve.cc", '"server/server.h"')

    def test_command_line_including_core_passes(self):
        self.passes("client/cli/local.cc", '"core/calibrate/calibrate.h"')

    def test_folder_without_a_layer(self):
        self.bites("extras/a.cc", "<vector>")

    def test_include_in_a_comment_passes(self):
        self.passes("core/chain/chain.h", "<vector>  // not \"core/robot/robot.h\"\n// #include <grpcpp/grpcpp.h>")


class LinkDirection(unittest.TestCase):
    def test_core_linking_protobuf(self):
        self.assertEqual(len(checks.link_direction("truepose_chain|core/chain|protobuf::libprotobuf")), 1)

    def test_core_linking_the_messages(self):
        self.assertEqual(len(checks.link_direction("truepose_chain|core/chain|truepose_proto\ntruepose_proto|proto|")), 1)

    def test_core_linking_grpc_and_sqlite(self):
        self.assertEqual(len(checks.link_direction("truepose_chain|core/chain|gRPC::grpc++;SQLite::SQLite3")), 2)

    def test_core_linking_upwards(self):
        graph = "truepose_chain|core/chain|truepose_robot\ntruepose_robot|core/robot|truepose_chain"
        self.assertEqual(len(checks.link_direction(graph)), 1)

    def test_store_linking_core(self):
        graph = "truepose_store|server/store|truepose_robot\ntruepose_robot|core/robot|"
        self.assertEqual(len(checks.link_direction(graph)), 1)

    def test_downwards_and_outside_libraries_pass(self):
        graph = "truepose_robot|core/robot|truepose_chain;absl::status;Eigen3::Eigen\ntruepose_chain|core/chain|"
        self.assertEqual(checks.link_direction(graph), [])

    def test_target_without_a_layer(self):
        self.assertEqual(len(checks.link_direction("truepose_extra|extras|")), 1)

    def test_empty_graph(self):
        self.assertEqual(len(checks.link_direction("\n")), 1)


class FunctionLength(TreeCase):
    def test_61_lines(self):
        self.write("core/base/a.cc", long_function(61))
        self.assertEqual(len(checks.function_length(self.root)), 1)

    def test_60_lines_pass(self):
        self.write("core/base/a.cc", long_function(60))
        self.assertEqual(checks.function_length(self.root), [])

    def test_method_in_a_class_in_a_namespace(self):
        self.write("core/base/a.h", "namespace a {\nclass B {\n public:\n" + long_function(61) + "};\n}\n")
        self.assertEqual(len(checks.function_length(self.root)), 1)

    def test_long_class_of_short_methods_passes(self):
        self.write("core/base/a.h", "class B {\n" + long_function(9) * 20 + "};\n")
        self.assertEqual(checks.function_length(self.root), [])

    def test_lambda_counts_to_its_function(self):
        self.write("core/base/a.cc", "void G() {\n  auto f = []() {\n" + "    H();\n" * 60 + "  };\n}\n")
        self.assertEqual([f.name for f in source.functions("void G() {\n  auto f = [] { H(); };\n}\n")], ["G"])
        self.assertEqual(len(checks.function_length(self.root)), 1)


class Functions(unittest.TestCase):
    def names(self, text):
        return [function.name for function in source.functions(text)]

    def test_braces_in_strings_and_comments_do_not_count(self):
        text = 'int F() {\n  return G("}", \'}\', R"x(})" })x");  // }\n  /* } */\n}\nint H() { return 1\'000; }\n'
        self.assertEqual([(f.name, f.lines) for f in source.functions(text)], [("F", 4), ("H", 1)])

    def test_constructor_with_braced_members(self):
        self.assertEqual(self.names("A::A(int b) : b_{b}, c_(b) {\n  F();\n}\nint G() { return 1; }"), ["A::A", "G"])

    def test_trailing_words_and_return_types(self):
        text = "int A::F() const noexcept {\n}\nauto G(int a) -> std::vector<int> {\n}\nbool operator==(A, B) {\n}\n"
        self.assertEqual(self.names(text), ["A::F", "G", "operator=="])

    def test_templates_with_defaults(self):
        self.assertEqual(self.names("template <typename T = int, int N = 3>\nT F(T a) {\n}\n"), ["F"])

    def test_initialisers_and_types_are_no_functions(self):
        text = "const int a[] = {1, 2};\nstd::function<void(int)> f = {};\nstruct P {\n  int x = 0;\n};\nint b{3};\n"
        self.assertEqual(self.names(text), [])

    def test_constant_that_holds_a_lambda(self):
        self.assertEqual(self.names("const auto f = [](int a) {\n  return a;\n};\n"), ["(lambda)"])

    def test_braced_default_argument(self):
        self.assertEqual(self.names("int F(A a = {}, B b = B{1}) {\n  return 1;\n}\n"), ["F"])

    def test_test_bodies_are_named_by_their_test(self):
        self.assertEqual(self.names("TEST(Chain, Sweeps) {\n}\n"), ["TEST(Chain, Sweeps)"])

    def test_lines_count_from_the_return_type(self):
        self.assertEqual([f.lines for f in source.functions("int\nF(int a,\n  int b) {\n  return a;\n}\n")], [5])


class FileLength(TreeCase):
    def test_501_lines(self):
        self.write("core/base/a.h", "\n" * 501)
        self.assertEqual(len(checks.file_length(self.root)), 1)

    def test_500_lines_pass(self):
        self.write("core/base/a.h", "\n" * 500)
        self.assertEqual(checks.file_length(self.root), [])


class Readme(TreeCase):
    def test_folder_without(self):
        self.write("README.md")
        self.write("core/a.h")
        self.assertEqual(checks.readme_in_every_folder(self.root), ["core: no README.md"])

    def test_built_and_hidden_folders_pass(self):
        for path in ("README.md", "build/dev/a.h", ".ci/run", "tests/__pycache__/a.pyc"):
            self.write(path)
        self.assertEqual(checks.readme_in_every_folder(self.root), [])


class EveryTestIsBuilt(TreeCase):
    def setUp(self):
        super().setUp()
        self.write("tests/CMakeLists.txt", "add_subdirectory(core)\n# add_subdirectory(formats)\n")
        self.write("tests/core/CMakeLists.txt", "truepose_test(a SOURCES a_test.cc)  # b_test.cc\n")
        self.write("tests/formats/CMakeLists.txt", "truepose_test(c SOURCES c_test.cc)\n")
        self.write("tests/core/a_test.cc")

    def test_named_test_passes(self):
        self.assertEqual(checks.every_test_is_built(self.root), [])

    def test_test_that_no_list_names(self):
        self.write("tests/core/b_test.cc")
        self.assertEqual(len(checks.every_test_is_built(self.root)), 1)

    def test_test_in_a_folder_that_is_not_reached(self):
        self.write("tests/formats/c_test.cc")
        self.assertEqual(len(checks.every_test_is_built(self.root)), 1)


class NoSkippedTest(TreeCase):
    def test_disabled_and_skipped(self):
        self.write("tests/a_test.cc", "TEST(A, DISABLED_B) {}\nTEST(A, C) { GTEST_SKIP(); }\n")
        self.assertEqual(len(checks.no_skipped_test(self.root)), 2)

    def test_word_in_a_comment_passes(self):
        self.write("tests/a_test.cc", "// never GTEST_SKIP\n")
        self.assertEqual(checks.no_skipped_test(self.root), [])


if __name__ == "__main__":
    unittest.main()
