// The only place where an index means a name. Parameters are errors of the nominal geometry (Delta
// Lambda, Eq. 2): their nominal value is 0, their identified value the correction, rad or m.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace truepose {

enum class ParameterGroup { kBase, kTool, kInstrument, kInternal };

// What the parameter is to its joint; also the order in which parameters are preferred (see
// identifiability.h).
enum class ParameterRole { kExternal, kJointOffset, kLength, kAngle, kEffect };

// Of the value inside. Effects of joints have units of their own.
enum class Unit {
  kMetre,
  kRadian,
  kRatio,  // rad/rad or m/m
  kRadianPerNewtonMetre,
  kMetrePerNewton,
  kRadianPerKelvin,
  kMetrePerKelvin,
};

struct Parameter {
  std::string name;  // "dq3", "da3", "dalpha3", "base.x"
  ParameterGroup group = ParameterGroup::kInternal;
  ParameterRole role = ParameterRole::kAngle;
  Unit unit = Unit::kRadian;

  bool is_angle() const { return unit == Unit::kRadian; }
};

class ParameterSet {
 public:
  // Appends; the name must be new. @returns its index.
  int Add(Parameter parameter);

  int size() const { return static_cast<int>(parameters_.size()); }
  const Parameter& operator[](int index) const { return parameters_[index]; }
  std::optional<int> Find(std::string_view name) const;
  auto begin() const { return parameters_.begin(); }
  auto end() const { return parameters_.end(); }

 private:
  std::vector<Parameter> parameters_;
  std::unordered_map<std::string, int> index_;
};

}  // namespace truepose
