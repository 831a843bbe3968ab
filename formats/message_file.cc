#include "formats/message_file.h"

#include <cmath>
#include <limits>
#include <optional>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/message_field.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"
#include "formats/yaml.h"
#include "formats/yaml_map.h"
#include "google/protobuf/duration.pb.h"
#include "google/protobuf/timestamp.pb.h"
#include "google/protobuf/util/time_util.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {
namespace {

using google::protobuf::EnumDescriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::util::TimeUtil;

// Pose sets of thousands of poses; the YAML library is slow on what is much larger.
constexpr size_t kMostBytes = 4 << 20;

bool IsPose(const FieldDescriptor& field) { return field.message_type() == v1::Pose::descriptor(); }

// One value of a field, which is one of a list when the field is repeated.
class Value {
 public:
  Value(const YamlNode& node, const std::string& path, const FieldDescriptor& field,
        const Unit* unit, const YamlFaults& faults)
      : node_(node), path_(path), field_(field), unit_(unit), faults_(faults) {}

  void Store(Message& message) const {
    switch (field_.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return StoreDouble(message);
      case FieldDescriptor::CPPTYPE_INT32:
      case FieldDescriptor::CPPTYPE_INT64:
      case FieldDescriptor::CPPTYPE_UINT64:
        return StoreInteger(message);
      case FieldDescriptor::CPPTYPE_BOOL:
        return StoreBool(message);
      case FieldDescriptor::CPPTYPE_ENUM:
        return StoreEnum(message);
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return StoreTime(message);
      default:
        return StoreText(message);
    }
  }

 private:
  const google::protobuf::Reflection& Of(const Message& message) const {
    return *message.GetReflection();
  }
  void Fault(std::string expected) const {
    faults_.Add(node_.line, path_, Describe(node_), std::move(expected));
  }
  bool is_scalar() const { return node_.kind == YamlNode::Kind::kScalar; }

  void StoreDouble(Message& message) const {
    const std::optional<double> number = NumberOf(node_, path_, faults_);
    if (!number.has_value()) return;
    const double value = unit_ == nullptr ? *number : unit_->to_si(*number);
    if (field_.is_repeated()) return Of(message).AddDouble(&message, &field_, value);
    Of(message).SetDouble(&message, &field_, value);
  }

  void StoreInteger(Message& message) const {
    const std::optional<double> number = NumberOf(node_, path_, faults_);
    if (!number.has_value()) return;
    const bool is_short = field_.cpp_type() == FieldDescriptor::CPPTYPE_INT32;
    // A double tells whole numbers apart up to here.
    const double most = is_short ? std::numeric_limits<int32_t>::max() : 9007199254740992.0;
    if (std::trunc(*number) != *number || std::abs(*number) > most) return Fault("a whole number");
    const bool is_unsigned = field_.cpp_type() == FieldDescriptor::CPPTYPE_UINT64;
    if (is_unsigned && *number < 0.0) return Fault("a whole number, 0 or more");
    const auto value = static_cast<int64_t>(*number);
    if (is_unsigned) return Of(message).SetUInt64(&message, &field_, static_cast<uint64_t>(value));
    if (is_short) return Of(message).SetInt32(&message, &field_, static_cast<int32_t>(value));
    Of(message).SetInt64(&message, &field_, value);
  }

  void StoreBool(Message& message) const {
    const bool yes = is_scalar() && node_.text == "true";
    if (!yes && !(is_scalar() && node_.text == "false")) return Fault("true or false");
    Of(message).SetBool(&message, &field_, yes);
  }

  void StoreEnum(Message& message) const {
    const EnumDescriptor& type = *field_.enum_type();
    const EnumValueDescriptor* value = is_scalar() ? type.FindValueByName(node_.text) : nullptr;
    if (value == nullptr) {
      std::vector<std::string> names;
      for (int i = 1; i < type.value_count(); ++i) names.push_back(type.value(i)->name());
      return Fault(AnyOf(names));
    }
    if (field_.is_repeated()) return Of(message).AddEnum(&message, &field_, value);
    Of(message).SetEnum(&message, &field_, value);
  }

  void StoreText(Message& message) const {
    if (!is_scalar()) return Fault("a text");
    if (field_.is_repeated()) return Of(message).AddString(&message, &field_, node_.text);
    Of(message).SetString(&message, &field_, node_.text);
  }

  void StoreTime(Message& message) const {
    Message* const stored = Of(message).MutableMessage(&message, &field_);
    if (auto* time = dynamic_cast<google::protobuf::Timestamp*>(stored)) {
      if (!is_scalar() || !TimeUtil::FromString(node_.text, time))
        Fault("a time such as 2027-03-01T00:00:00Z");
    } else if (auto* duration = dynamic_cast<google::protobuf::Duration*>(stored)) {
      if (!is_scalar() || !TimeUtil::FromString(node_.text, duration))
        Fault("seconds such as 86400s");
    }
  }

  const YamlNode& node_;
  const std::string& path_;
  const FieldDescriptor& field_;
  const Unit* const unit_;
  const YamlFaults& faults_;
};

// Where a map stands: in the file, and as a path of a field mask. Within lists there is none.
struct Place {
  std::string path;
  std::string mask;
  GivenFields* given;

  Place In(const std::string& key, const std::string& field) const {
    return {FieldPath(path, key), FieldPath(mask, field), given};
  }
  Place Item(size_t index) const { return {ItemPath(path, index), "", nullptr}; }
  void Give() const {
    if (given != nullptr) given->paths.push_back(mask);
  }
  void GiveIn(const Unit* unit) const {
    const bool in_si = unit != nullptr && (unit->symbol == "m" || unit->symbol == "rad");
    if (given != nullptr && in_si) given->in_si.push_back(mask);
  }
};

class Reader {
 public:
  explicit Reader(const YamlFaults& faults) : faults_(faults) {}

  void ReadMap(const YamlNode& node, const Place& place, Message& message) const {
    YamlMap map(node, place.path, faults_);
    const auto& descriptor = *message.GetDescriptor();
    // Names with units last: those without are then known and no slip of a unit.
    for (const bool with_unit : {false, true}) {
      for (int i = 0; i < descriptor.field_count(); ++i) {
        const FieldDescriptor& field = *descriptor.field(i);
        const FieldMeasure measure = MeasureOf(field);
        if ((measure.dimension != Dimension::kNone) != with_unit) continue;
        const Unit* unit = nullptr;
        const YamlNode* value = with_unit ? map.FindWithUnit(measure.stem, measure.dimension, &unit)
                                          : map.Find(field.name());
        if (value != nullptr) ReadField(*value, place, field, unit, message);
      }
    }
    map.CheckKeys();
  }

 private:
  void ReadField(const YamlNode& node, const Place& outer, const FieldDescriptor& field,
                 const Unit* unit, Message& message) const {
    Place place = outer.In(node.key, field.name());
    if (node.kind == YamlNode::Kind::kNull) {
      message.GetReflection()->ClearField(&message, &field);  // what a file before this gave
      return place.Give();
    }
    if (field.is_repeated()) return ReadList(node, place, field, unit, message);
    if (!IsGroup(field)) {
      place.Give();
      place.GiveIn(unit);
      return Value(node, place.path, field, unit, faults_).Store(message);
    }
    Message& group = *message.GetReflection()->MutableMessage(&message, &field);
    if (!IsPose(field)) return ReadMap(node, place, group);
    place.Give();
    place.given = nullptr;
    ReadMap(node, place, group);
    GiveRotation(static_cast<v1::Pose&>(group));
  }

  void ReadList(const YamlNode& node, const Place& place, const FieldDescriptor& field,
                const Unit* unit, Message& message) const {
    place.Give();
    const std::vector<YamlNode>& items = ListItems(node, place.path, faults_);
    for (size_t i = 0; i < items.size() && !IsEnough(faults_.faults); ++i) {
      const Place item = place.Item(i);
      if (field.message_type() != nullptr) {
        ReadMap(items[i], item, *message.GetReflection()->AddMessage(&message, &field));
      } else {
        Value(items[i], item.path, field, unit, faults_).Store(message);
      }
    }
  }

  // What says nothing of a rotation has none.
  static void GiveRotation(v1::Pose& pose) {
    if (pose.qx() == 0 && pose.qy() == 0 && pose.qz() == 0 && pose.qw() == 0) pose.set_qw(1);
  }

  const YamlFaults& faults_;
};

// The map at the end of `path`'s maps, which are made as they are needed.
YamlNode& EntryAt(YamlNode& root, std::string_view path) {
  YamlNode* node = &root;
  for (;;) {
    node->kind = YamlNode::Kind::kMap;
    const size_t dot = path.find('.');
    const std::string key(path.substr(0, dot));
    YamlNode* found = nullptr;
    for (YamlNode& item : node->items) {
      if (item.key == key && dot != std::string_view::npos) found = &item;
    }
    if (found == nullptr) {
      node->items.emplace_back();
      found = &node->items.back();
      found->key = key;
    }
    if (dot == std::string_view::npos) return *found;
    node = found;
    path.remove_prefix(dot + 1);
  }
}

// There are no lines in a command line.
absl::Status WithoutLines(const FaultList& faults, std::string_view option) {
  const std::string before = StrCat(option, ":1: ");
  FaultList list;
  for (const Fault& fault : faults.faults()) {
    std::string_view field = fault.field;
    const bool lined = ConsumePrefix(&field, before);
    list.Add(lined ? StrCat(option, " ", field) : fault.field, fault.found, fault.expected);
  }
  return list.ToStatus();
}

}  // namespace

absl::Status ReadMessageFile(const std::string& path, Message& message, GivenFields& given) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(path, kMostBytes));
  return ParseMessageFile(text, path, message, given);
}

absl::Status ParseMessageFile(std::string_view text, std::string_view file_name, Message& message,
                              GivenFields& given) {
  FaultList list;
  const YamlNode root = ParseYaml(text, file_name, list);
  if (!list.empty()) return list.ToStatus();
  Reader({file_name, list}).ReadMap(root, {"", "", &given}, message);
  return list.ToStatus();
}

absl::Status SetMessageFields(const std::vector<std::pair<std::string, std::string>>& fields,
                              std::string_view option, Message& message, GivenFields& given) {
  YamlNode root;
  root.kind = YamlNode::Kind::kMap;
  for (const auto& [key, text] : fields) {
    YamlNode& entry = EntryAt(root, key);
    entry.kind = text.empty() ? YamlNode::Kind::kNull : YamlNode::Kind::kScalar;
    entry.text = text;
  }
  FaultList list;
  Reader({option, list}).ReadMap(root, {"", "", &given}, message);
  return list.empty() ? absl::OkStatus() : WithoutLines(list, option);
}

}  // namespace truepose::formats
