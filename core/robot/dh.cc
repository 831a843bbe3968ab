#include "core/robot/dh.h"

#include <cassert>

namespace truepose {
namespace {

void AppendScrewAboutZ(const DhRow& row, JointType type, int joint, Chain* chain) {
  chain->push_back(Rotation(Axis::kZ, row.theta));
  chain->push_back(Translation(Axis::kZ, row.d));
  (*chain)[chain->size() - (type == JointType::kRevolute ? 2 : 1)].joint = joint;
}

void AppendScrewAboutX(const DhRow& row, Chain* chain) {
  chain->push_back(Translation(Axis::kX, row.a));
  chain->push_back(Rotation(Axis::kX, row.alpha));
}

}  // namespace

Chain ChainFromStandardDh(const std::vector<DhRow>& rows, const std::vector<JointType>& types) {
  assert(rows.size() == types.size());
  Chain chain;
  for (size_t i = 0; i < rows.size(); ++i) {
    AppendScrewAboutZ(rows[i], types[i], static_cast<int>(i), &chain);
    AppendScrewAboutX(rows[i], &chain);
  }
  return chain;
}

Chain ChainFromCraigDh(const std::vector<DhRow>& rows, const std::vector<JointType>& types) {
  assert(rows.size() == types.size());
  Chain chain;
  for (size_t i = 0; i < rows.size(); ++i) {
    AppendScrewAboutX(rows[i], &chain);
    AppendScrewAboutZ(rows[i], types[i], static_cast<int>(i), &chain);
  }
  return chain;
}

}  // namespace truepose
