#include "formats/yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_format.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

using Kind = YamlNode::Kind;

int LineOf(const YAML::Mark& mark) { return std::max(mark.line, 0) + 1; }

// Builds the tree from the events of the parser.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string_view file, FaultList& faults) : file_(file), faults_(faults) {}

  YamlNode TakeRoot() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { Place(Node(Kind::kNull, mark)); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    AddFault(LineOf(mark), "an alias (*)", "the value itself");
    Place(Node(Kind::kNull, mark));
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& text) override {
    YamlNode node = Node(Kind::kScalar, mark);
    node.text = text;
    Place(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    Open(Node(Kind::kSequence, mark));
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    Open(Node(Kind::kMap, mark));
  }
  void OnMapEnd() override { Close(); }

 private:
  // A list or map that is not closed yet, with the key that waits for its value.
  struct Level {
    YamlNode node;
    bool has_key = false;
    std::string key;
    int key_line = 0;
  };

  static YamlNode Node(Kind kind, const YAML::Mark& mark) {
    YamlNode node;
    node.kind = kind;
    node.line = LineOf(mark);
    return node;
  }

  void Open(YamlNode node) { open_.push_back({std::move(node), false, "", 0}); }

  void Close() {
    YamlNode node = std::move(open_.back().node);
    open_.pop_back();
    Place(std::move(node));
  }

  void Place(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (Level& level = open_.back(); level.node.kind == Kind::kMap && !level.has_key) {
      PlaceKey(level, node);
    } else {
      if (level.has_key) {
        node.key = std::exchange(level.key, "");
        node.line = level.key_line;
        level.has_key = false;
      }
      level.node.items.push_back(std::move(node));
    }
  }

  void PlaceKey(Level& level, const YamlNode& node) {
    if (node.kind != Kind::kScalar) AddFault(node.line, Describe(node) + " as a key", "a word");
    level.has_key = true;
    level.key = node.text;
    level.key_line = node.line;
  }

  void AddFault(int line, std::string found, std::string expected) {
    faults_.Add(StrCat(file_, ":", line), std::move(found), std::move(expected));
  }

  std::string_view file_;
  FaultList& faults_;
  std::vector<Level> open_;
  YamlNode root_;
};

// Without line ends at the end, where the YAML library would take them for a closing quote that is
// missing.
std::string_view Trimmed(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
}

// Throws what the YAML library throws.
YamlNode Build(std::string_view text, std::string_view file, FaultList& faults) {
  std::istringstream stream{std::string(Trimmed(text))};
  YAML::Parser parser(stream);
  TreeBuilder builder(file, faults);
  parser.HandleNextDocument(builder);
  YamlNode root = builder.TakeRoot();
  TreeBuilder next(file, faults);
  if (parser.HandleNextDocument(next)) {
    faults.Add(StrCat(file, ":", next.TakeRoot().line), "a second document", "one document");
  }
  return root;
}

bool IsSimpleWord(std::string_view text) {
  const auto is_word = [](char c) { return absl::ascii_isalnum(c) || c == '_' || c == '-'; };
  return !text.empty() && absl::ascii_isalpha(text[0]) &&
         std::all_of(text.begin(), text.end(), is_word) && AsciiToLower(text) != "null";
}

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

YamlNode ParseYaml(std::string_view text, std::string_view file_name, FaultList& faults) {
  text = WithoutByteOrderMark(text);
  const size_t at = FindNotUtf8(text);
  if (at != std::string_view::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
    faults.Add(StrCat(file_name, ":", line), "bytes of another encoding", "UTF-8 text");
    return {};
  }
  const size_t before = faults.faults().size();
  try {
    YamlNode root = Build(text, file_name, faults);
    return faults.faults().size() == before ? std::move(root) : YamlNode();
  } catch (const YAML::Exception& e) {
    faults.Add(StrCat(file_name, ":", LineOf(e.mark)), e.msg, "YAML");
  } catch (const std::exception& e) {
    faults.Add(std::string(file_name), e.what(), "YAML");
  }
  return {};
}

std::string Describe(const YamlNode& node) {
  switch (node.kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return Quoted(node.text);
    case Kind::kSequence:
      return StrCat("a list of ", node.items.size());
    case Kind::kMap:
      return "a map";
  }
  return "";
}

std::string YamlText(std::string_view text) {
  if (IsSimpleWord(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (IsControl(c)) {
      absl::StrAppendFormat(&quoted, "\\x%02X", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace truepose::formats
