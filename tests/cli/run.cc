#include "tests/cli/run.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/cli/truepose.h"
#include "google/protobuf/util/json_util.h"

namespace truepose::cli {
namespace {

using google::protobuf::Value;

const Value* Member(const Value& value, const std::string& key) {
  if (value.has_struct_value()) {
    const auto found = value.struct_value().fields().find(key);
    return found == value.struct_value().fields().end() ? nullptr : &found->second;
  }
  int index = -1;
  if (!value.has_list_value() || !absl::SimpleAtoi(key, &index)) return nullptr;
  if (index < 0 || index >= value.list_value().values_size()) return nullptr;
  return &value.list_value().values(index);
}

std::string Text(const Value& value) {
  if (value.kind_case() == Value::kStringValue) return value.string_value();
  if (value.kind_case() == Value::kNumberValue) return absl::StrCat(value.number_value());
  if (value.kind_case() == Value::kBoolValue) return value.bool_value() ? "true" : "false";
  if (value.has_list_value()) return absl::StrCat("[", value.list_value().values_size(), "]");
  return "{}";
}

}  // namespace

Ran RunCli(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = RunTruepose(arguments, {out, err});
  return {code, out.str(), err.str()};
}

google::protobuf::Struct OneObject(const std::string& text) {
  google::protobuf::Struct object;
  EXPECT_TRUE(!text.empty() && text.back() == '\n') << text;
  const auto status = google::protobuf::util::JsonStringToMessage(text, &object);
  EXPECT_TRUE(status.ok()) << status.ToString() << "\n" << text;
  return object;
}

std::string At(const google::protobuf::Struct& object, const std::string& path) {
  Value root;
  *root.mutable_struct_value() = object;
  const Value* value = &root;
  for (const std::string& key : std::vector<std::string>(absl::StrSplit(path, '.'))) {
    value = Member(*value, key);
    if (value == nullptr) {
      ADD_FAILURE() << "no " << path << " in " << object.ShortDebugString();
      return "";
    }
  }
  return Text(*value);
}

std::string TextOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string Example(const std::string& name) {
  return absl::StrCat(TRUEPOSE_SOURCE_DIR, "/deploy/examples/", name);
}

}  // namespace truepose::cli
