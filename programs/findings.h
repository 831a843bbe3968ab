// Collects what a reader finds, and decides at the end which variables' values are targets.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "programs/program.h"

namespace truepose::programs {

// Names are handed over in one spelling (lower case where the dialect doesn't tell cases apart).
class Findings {
 public:
  // Joint values in a motion.
  void AddTarget(JointTarget target) { targets_.push_back(std::move(target)); }

  // Joint values given to the variable `name`. `typed`: its type says that they are joint values,
  // so they count without a motion to them as well (declarations have files of their own in KRL).
  void AddValue(const std::string& name, JointTarget target, bool typed);

  // Anything else given to it.
  void AddOtherValue(const std::string& name, int line) { other_values_.push_back({name, line}); }

  // The variable is the whole target of a motion.
  void AddMotion(const std::string& name, int line) { motions_.push_back({name, line}); }

  // Any other place where the name stands.
  void AddOtherUse(const std::string& name, int line) { other_uses_.try_emplace(name, line); }

  void PassThrough(int line, std::string reason) { remarks_.push_back({line, std::move(reason)}); }

  // All of it in the order of the text, each remark once.
  Program Finish() &&;

 private:
  struct Value {
    std::string name;
    JointTarget target;
    bool typed;
  };
  struct Place {
    std::string name;
    int line;
  };

  void JudgeValues();
  void JudgeMotions();
  void JudgeOtherValues();

  std::vector<JointTarget> targets_;
  std::vector<Remark> remarks_;
  std::vector<Value> values_;
  std::vector<Place> motions_, other_values_;
  std::unordered_map<std::string, int> other_uses_;  // name -> first line
  std::unordered_set<std::string> moved_to_, valued_, corrected_;
};

}  // namespace truepose::programs
