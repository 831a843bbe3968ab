#include "formats/urdf_tree.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <string>

#include "absl/strings/str_join.h"
#include "core/base/status_macros.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

constexpr int kDeepest = 100;
constexpr size_t kMostLinks = 2000;

// urdfdom says what is wrong to a logger of the whole process only.
class UrdfdomErrors : public console_bridge::OutputHandler {
 public:
  UrdfdomErrors() : lock_(OfProcess()) { console_bridge::useOutputHandler(this); }
  ~UrdfdomErrors() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) texts_.push_back(text);
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  static std::mutex& OfProcess() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  std::vector<std::string> texts_;
};

// Behind the tag that begins at `begin`; '>' in quotes does not end it.
size_t EndOfTag(std::string_view text, size_t begin) {
  char quote = 0;
  for (size_t i = begin; i < text.size(); ++i) {
    if (quote != 0) {
      if (text[i] == quote) quote = 0;
    } else if (text[i] == '"' || text[i] == '\'') {
      quote = text[i];
    } else if (text[i] == '>') {
      return i + 1;
    }
  }
  return text.size();
}

size_t Behind(std::string_view text, std::string_view mark, size_t begin) {
  const size_t found = text.find(mark, begin);
  return found == std::string_view::npos ? text.size() : found + mark.size();
}

// How deep elements stand in one another, at least as deep as a parser that recurses goes.
int DepthOf(std::string_view text) {
  int depth = 0, deepest = 0;
  for (size_t i = text.find('<'); i != std::string_view::npos; i = text.find('<', i)) {
    const std::string_view rest = text.substr(i, 9);
    if (rest.starts_with("<!--")) {
      i = Behind(text, "-->", i);
    } else if (rest.starts_with("<![CDATA[")) {
      i = Behind(text, "]]>", i);
    } else if (rest.starts_with("<!") || rest.starts_with("<?")) {
      i = Behind(text, ">", i);
    } else if (rest.starts_with("</")) {
      depth = std::max(0, depth - 1);
      i = Behind(text, ">", i);
    } else {
      i = EndOfTag(text, i);
      deepest = std::max(deepest, depth + 1);
      if (text.substr(0, i).ends_with("/>")) continue;
      ++depth;
    }
  }
  return deepest;
}

size_t CountOf(std::string_view text, std::string_view word) {
  size_t count = 0;
  for (size_t i = text.find(word); i != std::string_view::npos; i = text.find(word, i + 1)) ++count;
  return count;
}

absl::Status CheckText(std::string_view text, const std::string& file) {
  if (FindNotUtf8(text) != std::string_view::npos)
    return FaultStatus(file, "bytes that are no UTF-8", "URDF in UTF-8");
  if (DepthOf(text) > kDeepest)
    return FaultStatus(file, "elements nested too deeply", StrCat("at most ", kDeepest));
  if (const size_t links = CountOf(text, "<link"); links > kMostLinks)
    return FaultStatus(file, StrCat(links, " links"), StrCat("at most ", kMostLinks));
  return absl::OkStatus();
}

// A link below two joints makes urdfdom's tree none.
absl::Status CheckParents(const urdf::ModelInterface& model, const std::string& file) {
  FaultList faults;
  for (const auto& [name, joint] : model.joints_) {
    const urdf::LinkConstSharedPtr child = model.getLink(joint->child_link_name);
    if (child->parent_joint == joint) continue;
    faults.Add(
        StrCat(file, ": link ", Quoted(child->name)),
        StrCat("the child of joints ", Quoted(name), " and ", Quoted(child->parent_joint->name)),
        "one joint above each link");
  }
  return faults.ToStatus();
}

absl::StatusOr<urdf::LinkConstSharedPtr> LinkByName(const urdf::ModelInterface& model,
                                                    const std::string& name,
                                                    const std::string& file) {
  if (urdf::LinkConstSharedPtr link = model.getLink(name)) return link;
  std::vector<std::string> names;
  for (const auto& [other, link] : model.links_) names.push_back(other);
  const std::string nearest = Nearest(name, names);
  return FaultStatus(StrCat(file, ": link ", Quoted(name)), "no such link",
                     nearest.empty() ? "a link of the file" : nearest);
}

// Links without a joint below them, from `base` on.
std::vector<urdf::LinkConstSharedPtr> LeavesBelow(const urdf::LinkConstSharedPtr& base) {
  std::vector<urdf::LinkConstSharedPtr> leaves, open = {base};
  while (!open.empty()) {
    const urdf::LinkConstSharedPtr link = open.back();
    open.pop_back();
    if (link->child_links.empty()) leaves.push_back(link);
    open.insert(open.end(), link->child_links.begin(), link->child_links.end());
  }
  return leaves;
}

absl::StatusOr<urdf::LinkConstSharedPtr> OnlyLeaf(const urdf::LinkConstSharedPtr& base,
                                                  const std::string& file) {
  const std::vector<urdf::LinkConstSharedPtr> leaves = LeavesBelow(base);
  if (leaves.size() == 1) return leaves[0];
  std::vector<std::string> names;
  for (const urdf::LinkConstSharedPtr& leaf : leaves) names.push_back(leaf->name);
  std::sort(names.begin(), names.end());
  if (names.size() > 10) names.resize(10);
  return FaultStatus(
      file, StrCat(leaves.size(), " links without a joint below them"),
      StrCat("the link of the flange, named with --urdf-tip LINK, such as ", AnyOf(names)));
}

}  // namespace

absl::StatusOr<urdf::ModelInterfaceSharedPtr> ParseUrdfTree(std::string_view text,
                                                            std::string_view file_name) {
  const std::string file(file_name);
  TRUEPOSE_RETURN_IF_ERROR(CheckText(text, file));
  const UrdfdomErrors errors;
  FaultList faults;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(std::string(text));
  } catch (const std::exception& error) {
    faults.Add(file, error.what(), "a robot in URDF");
  }
  for (const std::string& error : errors.texts()) faults.Add(file, error, "a robot in URDF");
  if (model == nullptr && faults.empty()) faults.Add(file, "no robot", "a robot in URDF");
  if (!faults.empty()) return faults.ToStatus();
  TRUEPOSE_RETURN_IF_ERROR(CheckParents(*model, file));
  return model;
}

absl::StatusOr<UrdfPath> FindUrdfPath(const urdf::ModelInterface& model, const UrdfEnds& ends,
                                      std::string_view file_name) {
  const std::string file(file_name);
  UrdfPath path{model.getRoot(), {}};
  if (!ends.base.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(path.base, LinkByName(model, ends.base, file));
  }
  TRUEPOSE_ASSIGN_OR_RETURN(urdf::LinkConstSharedPtr link, ends.tip.empty()
                                                               ? OnlyLeaf(path.base, file)
                                                               : LinkByName(model, ends.tip, file));
  const std::string tip = link->name;
  // A ring of links apart from the tree has no end upwards.
  while (link != path.base && link->parent_joint && path.joints.size() < model.joints_.size()) {
    path.joints.push_back(link->parent_joint);
    link = link->getParent();
  }
  std::reverse(path.joints.begin(), path.joints.end());
  if (link == path.base) return path;
  return FaultStatus(StrCat(file, ": link ", Quoted(tip)),
                     StrCat("not below ", Quoted(path.base->name)), "a tip below the base");
}

}  // namespace truepose::formats
